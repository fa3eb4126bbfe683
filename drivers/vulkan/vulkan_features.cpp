// SPDX-License-Identifier: MIT
#include "drivers/vulkan/vulkan_features.h"

namespace lucent {

namespace {

// Calls p_visit(name, flag of p_features) for each.
template <typename Features, typename Visit>
void visit_required(Features &p_features, Visit &&p_visit) {
	p_visit("dynamicRendering", p_features.v13.dynamicRendering);
	p_visit("synchronization2", p_features.v13.synchronization2);
	p_visit("maintenance4", p_features.v13.maintenance4);
	p_visit("shaderTerminateInvocation", p_features.v13.shaderTerminateInvocation);
	p_visit("shaderDemoteToHelperInvocation", p_features.v13.shaderDemoteToHelperInvocation);
	p_visit("scalarBlockLayout", p_features.v12.scalarBlockLayout);
}

template <typename Features, typename Visit>
void visit_optional(Features &p_features, Visit &&p_visit) {
	p_visit("depthClamp", p_features.core.features.depthClamp);
	p_visit("samplerAnisotropy", p_features.core.features.samplerAnisotropy);
	p_visit("imageCubeArray", p_features.core.features.imageCubeArray);
	p_visit("independentBlend", p_features.core.features.independentBlend);
	p_visit("fillModeNonSolid", p_features.core.features.fillModeNonSolid);
	p_visit("multiDrawIndirect", p_features.core.features.multiDrawIndirect);
	p_visit("fragmentStoresAndAtomics", p_features.core.features.fragmentStoresAndAtomics);
	p_visit("vertexPipelineStoresAndAtomics", p_features.core.features.vertexPipelineStoresAndAtomics);
	p_visit("shaderImageGatherExtended", p_features.core.features.shaderImageGatherExtended);
	p_visit("shaderStorageImageExtendedFormats", p_features.core.features.shaderStorageImageExtendedFormats);
	p_visit("shaderStorageImageReadWithoutFormat", p_features.core.features.shaderStorageImageReadWithoutFormat);
	p_visit("shaderStorageImageWriteWithoutFormat", p_features.core.features.shaderStorageImageWriteWithoutFormat);
	p_visit("shaderInt16", p_features.core.features.shaderInt16);
	p_visit("shaderInt64", p_features.core.features.shaderInt64);
	p_visit("textureCompressionBC", p_features.core.features.textureCompressionBC);
	p_visit("multiview", p_features.v11.multiview);
	p_visit("shaderDrawParameters", p_features.v11.shaderDrawParameters);
	p_visit("storageBuffer16BitAccess", p_features.v11.storageBuffer16BitAccess);
	p_visit("shaderFloat16", p_features.v12.shaderFloat16);
	p_visit("shaderInt8", p_features.v12.shaderInt8);
	p_visit("storageBuffer8BitAccess", p_features.v12.storageBuffer8BitAccess);
	p_visit("shaderBufferInt64Atomics", p_features.v12.shaderBufferInt64Atomics);
	p_visit("shaderOutputLayer", p_features.v12.shaderOutputLayer);
	p_visit("drawIndirectCount", p_features.v12.drawIndirectCount);
	p_visit("subgroupSizeControl", p_features.v13.subgroupSizeControl);
	p_visit("computeFullSubgroups", p_features.v13.computeFullSubgroups);
}

} // namespace

VulkanFeatures::VulkanFeatures() {
	core.pNext = &v11;
	v11.pNext = &v12;
	v12.pNext = &v13;
}

void VulkanFeatures::query(VkPhysicalDevice p_device) {
	vkGetPhysicalDeviceFeatures2(p_device, &core);
}

std::string VulkanFeatures::missing() const {
	std::string names;
	visit_required(*this, [&](const char *p_name, VkBool32 p_value) {
		if (!p_value) {
			names += names.empty() ? p_name : std::string(", ") + p_name;
		}
	});
	return names;
}

void VulkanFeatures::keep_wanted() {
	VulkanFeatures wanted;
	std::vector<VkBool32> values;
	auto save = [&](const char *, VkBool32 p_value) { values.push_back(p_value); };
	visit_required(*this, save);
	visit_optional(*this, save);
	size_t next = 0;
	auto restore = [&](const char *, VkBool32 &r_value) { r_value = values[next++]; };
	visit_required(wanted, restore);
	visit_optional(wanted, restore);
	core.features = wanted.core.features;
	v11 = wanted.v11;
	v12 = wanted.v12;
	v13 = wanted.v13;
	core.pNext = &v11;
	v11.pNext = &v12;
	v12.pNext = &v13;
}

std::vector<std::string> VulkanFeatures::optional_names() const {
	std::vector<std::string> names;
	visit_optional(*this, [&](const char *p_name, VkBool32 p_value) {
		if (p_value) {
			names.push_back(p_name);
		}
	});
	return names;
}

} // namespace lucent

// SPDX-License-Identifier: MIT
#include "servers/core/file_io.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace lucent {

namespace {

struct FileDescriptor {
	int fd = -1;
	~FileDescriptor() {
		if (fd >= 0) {
			::close(fd);
		}
	}
};

Error system_error(const std::string &p_path, const char *p_action) {
	return make_error("{}: cannot {}: {}", p_path, p_action, std::strerror(errno));
}

bool write_all(int p_fd, std::span<const std::byte> p_bytes) {
	size_t done = 0;
	while (done < p_bytes.size()) {
		const ssize_t count = ::write(p_fd, p_bytes.data() + done, std::min<size_t>(p_bytes.size() - done, 1 << 30));
		if (count < 0 && errno == EINTR) {
			continue;
		}
		if (count <= 0) {
			return false;
		}
		done += size_t(count);
	}
	return true;
}

Status write_in_place(const std::string &p_path, std::span<const std::byte> p_bytes) {
	FileDescriptor file{ ::open(p_path.c_str(), O_WRONLY | O_CLOEXEC) };
	if (file.fd < 0 || !write_all(file.fd, p_bytes)) {
		return system_error(p_path, "write");
	}
	return Ok{};
}

} // namespace

Result<std::vector<std::byte>> read_file(const std::string &p_path, uint64_t p_max_bytes) {
	// O_NONBLOCK: opening a pipe without a writer would wait for ever.
	FileDescriptor file{ ::open(p_path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK) };
	struct stat status = {};
	if (file.fd < 0 || ::fstat(file.fd, &status) != 0) {
		return system_error(p_path, "read");
	}
	if (!S_ISREG(status.st_mode)) {
		return make_error("{}: cannot read: {}", p_path, S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file");
	}
	if (uint64_t(status.st_size) > p_max_bytes) {
		return make_error("{}: {} bytes are more than the limit of {}", p_path, status.st_size, p_max_bytes);
	}
	std::vector<std::byte> bytes(static_cast<size_t>(status.st_size));
	size_t done = 0;
	while (done < bytes.size()) {
		const ssize_t count = ::read(file.fd, bytes.data() + done, std::min<size_t>(bytes.size() - done, 1 << 30));
		if (count < 0 && errno == EINTR) {
			continue;
		}
		if (count < 0) {
			return system_error(p_path, "read");
		}
		if (count == 0) {
			break;
		}
		done += size_t(count);
	}
	bytes.resize(done);
	return bytes;
}

Status write_file(const std::string &p_path, std::span<const std::byte> p_bytes) {
	struct stat status = {};
	std::string target = p_path;
	if (::stat(p_path.c_str(), &status) == 0) {
		if (S_ISDIR(status.st_mode)) {
			return make_error("{}: cannot write: it is a folder", p_path);
		}
		if (!S_ISREG(status.st_mode)) {
			return write_in_place(p_path, p_bytes);
		}
		char resolved[PATH_MAX];
		if (::realpath(p_path.c_str(), resolved)) {
			target = resolved;
		}
	}
	static std::atomic<uint32_t> counter = 0;
	const std::string temporary = fmt::format("{}.partial-{}-{}", target, ::getpid(), counter++);
	bool written = false;
	{
		FileDescriptor file{ ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666) };
		if (file.fd < 0) {
			return system_error(p_path, "write");
		}
		written = write_all(file.fd, p_bytes);
	}
	if (!written || ::rename(temporary.c_str(), target.c_str()) != 0) {
		const Error error = system_error(p_path, "write");
		::unlink(temporary.c_str());
		return error;
	}
	return Ok{};
}

std::string path_folder(const std::string &p_path) {
	const size_t slash = p_path.rfind('/');
	return slash == std::string::npos ? std::string() : p_path.substr(0, slash + 1);
}

std::string path_extension(const std::string &p_path) {
	const size_t dot = p_path.rfind('.');
	if (dot == std::string::npos || p_path.find('/', dot) != std::string::npos) {
		return {};
	}
	std::string extension = p_path.substr(dot + 1);
	for (char &c : extension) {
		c = (c >= 'A' && c <= 'Z') ? char(c + 32) : c;
	}
	return extension;
}

} // namespace lucent

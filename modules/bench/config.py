# An optional module: present means offered as module_<name>_enabled. depends: modules that it cannot be built without.
depends = ["image", "reference"]

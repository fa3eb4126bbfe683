# An optional module: present means offered as module_<name>_enabled.

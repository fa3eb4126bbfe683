# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# The command `./lucent test`; sourced by the launcher, whose functions and lists it uses.

test_usage() {
	cat <<'TEXT'
usage: ./lucent test [--ci] [--device NAME] [--filter TEXT]

  --device NAME  run the GPU tests on this device (index or part of its name) instead of lavapipe, the CPU device of Mesa
  --filter TEXT  only cases with TEXT in their names, and none of the other checks
  --ci           also: unit tests under the address and undefined-behaviour sanitizers (built by clang), three fuzzers for a minute
                 each, GPU tests on SwiftShader

Steps: checks of the tree, unit tests, GPU tests under validation (those of the command line among them), the Python module's tests and samples. The last line is `N passed, N failed`.
TEXT
}

passed=0
failed=0
failures=()

# step NAME COMMAND…: a check that passes or fails as a whole.
step() {
	local name=$1 start=$SECONDS
	shift
	say "== $name"
	if "$@"; then
		passed=$((passed + 1))
	else
		failed=$((failed + 1))
		failures+=("$name")
	fi
	say "== $name: $((SECONDS - start)) s"
}

# suite NAME COMMAND…: a test program that writes "PASSED FAILED SKIPPED" into the file that --results names.
suite() {
	local name=$1 start=$SECONDS results=$root/bin/test_results status=0 ok=0 bad=0 skipped=0
	shift
	rm -f "$results"
	say "== $name"
	"$@" --results "$results" || status=$?
	[[ -f $results ]] && read -r ok bad skipped <"$results"
	if ((status != 0 && bad == 0)); then # it died
		bad=1
	fi
	((bad == 0)) || failures+=("$name")
	passed=$((passed + ok))
	failed=$((failed + bad))
	say "== $name: $ok passed, $bad failed, $skipped skipped for what the device or the machine lacks, $((SECONDS - start)) s"
}

check_format() {
	local tool files
	tool=$(command -v clang-format-14 || command -v clang-format)
	find "$root"/{servers,drivers,modules,tests} -name '*.cpp' -print0 -o -name '*.h' -print0 |
		xargs -0 "$tool" --dry-run 2>"$root/bin/format.log" || true
	files=$(sed -n 's/^\([^:]*\):[0-9].*\[-Wclang-format-violations\]$/\1/p' "$root/bin/format.log" | sort -u)
	[[ -n $files ]] || return 0
	say "not as clang-format -i leaves them:"
	printf '  %s\n' $files
	return 1
}

# gpu_suite NAME PROGRAM DEVICE ICD: ICD, if any, is the one driver that the loader sees.
gpu_suite() {
	local name=$1 program=$2 device=$3 icd=$4 settings=(LUCENT_VALIDATION=1)
	[[ -z $icd ]] || settings+=(VK_DRIVER_FILES="$icd" VK_ICD_FILENAMES="$icd")
	suite "$name" env "${settings[@]}" "$program" --gpu-only --root "$root" ${device:+--device "$device"} "${filter[@]}"
}

# The Python module: its own tests and the samples of doc/samples/python, then its stubs and types.
python_suite() {
	local start=$SECONDS status=0 log=$root/bin/python_tests.log icd=$1 summary ok bad skipped settings=(LUCENT_VALIDATION=1 LUCENT_VALIDATION_ABORT=1 PYTHONPATH="$root/bin/python" PYTHONDONTWRITEBYTECODE=1)
	[[ -z $icd ]] || settings+=(VK_DRIVER_FILES="$icd" VK_ICD_FILENAMES="$icd")
	say "== Python"
	env "${settings[@]}" timeout 600 /usr/bin/python3 -m pytest -q -p no:cacheprovider "$root/tests/python" 2>&1 | tee "$log" >&2 || status=1
	summary=$(tail -n 1 "$log")
	ok=$(sed -n 's/.* \([0-9]\+\) passed.*/\1/p' <<<" $summary")
	bad=$(sed -n 's/.* \([0-9]\+\) failed.*/\1/p' <<<" $summary")
	skipped=$(sed -n 's/.* \([0-9]\+\) skipped.*/\1/p' <<<" $summary")
	if ((status != 0 && ${bad:-0} == 0)); then # it died
		bad=1
	fi
	((${bad:-0} == 0)) || failures+=("Python")
	passed=$((passed + ${ok:-0}))
	failed=$((failed + ${bad:-0}))
	say "== Python: ${ok:-0} passed, ${bad:-0} failed, ${skipped:-0} skipped, $((SECONDS - start)) s"
}

check_stubs() {
	(cd "$root/bin" && MYPYPATH=$root/bin/python PYTHONPATH=$root/bin/python /usr/bin/python3 -m mypy.stubtest lucent --allowlist "$root/tests/python/stubtest_allowlist.txt" --ignore-missing-stub --ignore-unused-allowlist >&2)
}

check_types() {
	(cd "$root/bin" && MYPYPATH=$root/bin/python /usr/bin/python3 -m mypy --strict --cache-dir "$root/bin/mypy" "$root"/doc/samples/python/*.py >&2)
}

# Prints the ICD file of SwiftShader, which Debian has inside of Chromium. Only that one library is used, so nothing is installed.
swiftshader_icd() {
	local library=/usr/lib/chromium/libvk_swiftshader.so folder=$root/bin/swiftshader
	mkdir -p "$folder"
	if [[ ! -f $library ]]; then
		library=$folder/usr/lib/chromium/libvk_swiftshader.so
	fi
	if [[ ! -f $library ]]; then
		[[ ${LUCENT_NO_INSTALL:-0} == 0 ]] || die "SwiftShader is missing. To get it: apt-get install chromium-common"
		(cd "$folder" && apt-get -q download chromium-common >&2 && dpkg-deb -x chromium-common_*.deb . && rm chromium-common_*.deb)
	fi
	printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "1.3.0"}}\n' "$library" >"$folder/icd.json"
	printf '%s\n' "$folder/icd.json"
}

lavapipe_icd() {
	local file
	for file in /usr/share/vulkan/icd.d/lvp_icd.*.json /etc/vulkan/icd.d/lvp_icd.*.json; do
		if [[ -f $file ]]; then
			printf '%s\n' "$file"
			return
		fi
	done
	die "lavapipe is missing: install mesa-vulkan-drivers, or name a device with --device"
}

# One fuzzer, for a minute, from the committed seeds; what it finds stays in bin/fuzz. A fixed seed: the same tree gives the same verdict.
fuzz() {
	local name=$1 folder=$root/bin/fuzz runs
	mkdir -p "$folder/$name"
	case $name in # the same inputs on every machine that is fast enough
		gltf) runs=400000 ;;
		tscn) runs=60000 ;;
		*) runs=80000 ;;
	esac
	"$root/bin/fuzz_$name" -max_total_time=60 -runs=$runs -seed=1 -timeout=20 -rss_limit_mb=2560 -max_len=16384 -artifact_prefix="$folder/$name-" \
		"$folder/$name" "$root/tests/data/fuzz/$name" >"$folder/$name.log" 2>&1
}

# All fuzzers, two at a time.
run_fuzzers() {
	local name status=0
	rm -rf "$root"/bin/fuzz/{gltf,tscn,image} # what earlier runs found stays
	fuzz gltf &
	fuzz tscn || status=1
	wait $! || status=1
	fuzz image || status=1
	for name in gltf tscn image; do
		if ! grep '^Done' "$root/bin/fuzz/$name.log" >&2; then
			say "fuzz_$name: the input is bin/fuzz/$name-*, the log bin/fuzz/$name.log, which ends"
			tail -n 25 "$root/bin/fuzz/$name.log" >&2
		fi
	done
	return $status
}

run_ci_steps() {
	local program=$root/bin/lucent_tests.debug_asan_clang icd
	say "== sanitizer build"
	run_scons cxx=clang++ target=debug asan=1 tests=1 bin/lucent_tests.debug_asan_clang bin/fuzz_gltf bin/fuzz_tscn bin/fuzz_image >&2 || die "the sanitizer build failed"
	suite "unit tests, sanitizers" "$program" --root "$root"
	step "fuzzers of .glb, .tscn and images, a minute each" run_fuzzers
	icd=$(swiftshader_icd)
	gpu_suite "GPU tests, SwiftShader" "$root/bin/lucent_tests" "" "$icd"
}

run_tests() {
	local ci=0 device="" icd="" start=$SECONDS
	filter=()
	while (($#)); do
		case $1 in
			--ci) ci=1 ;;
			--device | --filter)
				(($# > 1)) || { say "$1 needs a value"; exit $exit_usage; }
				if [[ $1 == --device ]]; then device=$2; else filter=(--filter "$2"); fi
				shift
				;;
			--help | -h)
				test_usage
				return
				;;
			*)
				say "./lucent test has no option '$1'; --help lists them"
				exit $exit_usage
				;;
		esac
		shift
	done

	local packages=("${render_packages[@]}" "${test_packages[@]}")
	((ci == 0)) || packages+=("${ci_packages[@]}")
	ensure_packages "${packages[@]}"
	ensure_built lucent_tests tests tests=1 bin/lucent bin/lucent_tests
	ensure_built lucent "" bin/lucent
	[[ -n $device ]] || icd=$(lavapipe_icd)

	if ((${#filter[@]} == 0)); then
		step "rules of the tree" python3 -B "$root/tests/check_tree.py"
		step "format of the sources" check_format
	fi
	suite "unit tests" "$root/bin/lucent_tests" --root "$root" "${filter[@]}"
	gpu_suite "GPU tests" "$root/bin/lucent_tests" "$device" "$icd"
	if ((${#filter[@]} == 0)); then
		ensure_python_built
		python_suite "$icd"
		step "stubs of the Python module" check_stubs
		step "types of the Python samples" check_types
		((ci == 0)) || run_ci_steps
	fi

	if ((passed + failed == 0)); then
		say "no case has '${filter[1]}' in its name"
		failed=1
	fi
	((${#failures[@]} == 0)) || say "failed in: $(printf '%s; ' "${failures[@]}")"
	say "tests took $((SECONDS - start)) s"
	printf '%d passed, %d failed\n' "$passed" "$failed"
	((failed == 0))
}

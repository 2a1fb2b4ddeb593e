#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Uses trysquare as somebody else's project would: installed and found, or as a folder (add_subdirectory, shared).

find_package:     installs an existing build into an empty prefix, builds the consumer against it, runs both.
add_subdirectory: builds the libraries inside the consumer, shared, and runs it.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

CONSUMER = pathlib.Path(__file__).resolve().parent / "consumer"
SOURCE = CONSUMER.parents[2]
# MPV of the consumer's cloud: eight corners of a 0.2 x 0.2 x 0.02 m box, every neighborhood all of it: 8/7 * 0.01^2.
EXPECTED = "mpv_m2 0.000114285714"


def run(*command: str | pathlib.Path) -> str:
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(str(word) for word in command)}: exit {done.returncode}\n{done.stdout}")
    return done.stdout


def build_consumer(folder: pathlib.Path, *options: str) -> str:
    """Builds and runs the consumer; what it printed."""
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    run("cmake", "-S", CONSUMER, "-B", folder, "-G", "Ninja", *options, *launcher)
    run("cmake", "--build", folder, "--target", "consumer", "--parallel", str(os.cpu_count()))
    return run(folder / "consumer", folder)


def run_simulator(folder: pathlib.Path) -> str:
    """Builds what links trysquare::simulation; what it printed. Who wants a metric does not link Embree."""
    if "embree" in run("ldd", folder / "consumer"):
        sys.exit("the consumer links Embree although it simulates nothing")
    run("cmake", "--build", folder, "--target", "simulator")
    printed = run(folder / "simulator")
    if "range_m 2.000000000000" not in printed:
        sys.exit(f"expected a range of 2 m, found '{printed}'")
    return printed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("how", choices=["find_package", "add_subdirectory"])
    parser.add_argument("--build", type=pathlib.Path, help="build folder to install from (find_package)")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="trysquare-install-") as folder:
        work = pathlib.Path(folder)
        if arguments.how == "find_package":
            if arguments.build is None:
                parser.error("find_package needs --build")
            prefix = work / "prefix"
            run("cmake", "--install", arguments.build, "--prefix", prefix)
            leaks = [path for path in prefix.rglob("*.cmake") if str(SOURCE) in path.read_text(encoding="utf-8")]
            if leaks:
                sys.exit(f"the installed package refers to the source tree: {leaks[0].name}")
            printed = build_consumer(work / "consumer", f"-DCMAKE_PREFIX_PATH={prefix}")
            printed += run_simulator(work / "consumer")
            command = prefix / "bin/trysquare"
            if command.exists():  # not there when the build was made without the command
                print(run(command, "--version").strip())
        else:
            # Without a build type, so neither optimised nor with symbols: what is tested is that it builds and links.
            printed = build_consumer(work / "consumer", f"-DTRYSQUARE_SOURCE={SOURCE}", "-DBUILD_SHARED_LIBS=ON")
    print(printed.strip())
    if EXPECTED not in printed:
        sys.exit(f"expected '{EXPECTED}'")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Every stored number, confirmed or made anew, in the order in which they need one another: ``make stored``.

    python -m benchmarks.stored [--renew] [--jobs N] [NAME ...]

A number whose code is the one that made it is left alone. A stale one is confirmed where a sample tells enough: the
sample is measured again, agrees within its error bars, and the file gets today's digest. Where it does not agree, and
where there is no sample, everything is measured anew. ``--renew`` measures everything anew, fresh or not.
"""

import argparse
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from bent_beam.stored import is_stale

ROOT = Path(__file__).resolve().parents[1]
PROGRAMS = "bent_beam_programs"
BENCHMARK, THESIS, REPORT = (f"{PROGRAMS}.{name}" for name in ("open_benchmark", "thesis", "report"))
GALLERY = "out/gallery"


@dataclass(frozen=True)
class Numbers:
    """Stored numbers. files : relative to the programs; confirm, renew : arguments of Python, a command after another;
    waits_for : the numbers that they are made of or shown beside, before them in :data:`ALL`."""

    name: str
    files: tuple[str, ...]
    renew: tuple[str, ...]
    confirm: str | None = None
    waits_for: tuple[str, ...] = ()


BOUNCES, STUDIES = f"-m {BENCHMARK}.bounce_reference", f"-m {THESIS}.stored_studies"
DRAWN = (f"-m comparison.command_line gallery --out {GALLERY} --jobs {{jobs}}", f"-m {THESIS}.stored_numbers {GALLERY}")
SPEEDS = ("report/stored/work-precision.json", "report/stored/work-precision-first-order.json")
ALL = (
    Numbers("restitutions", ("open_benchmark/bounce_reference.json",), (BOUNCES,), f"{BOUNCES} --confirm"),
    Numbers("studies", ("stored_studies/studies.json",), (f"{STUDIES} --jobs {{jobs}}",)),
    Numbers("numbers", ("stored_studies/numbers.json",), DRAWN, waits_for=("studies",)),
    Numbers("work and precision", SPEEDS, (f"-m {REPORT}.work",), waits_for=("numbers",)),
    Numbers("references", ("open_benchmark/references.json",), (f"-m {BENCHMARK}.release",), None, ("restitutions",)),
)
"""Work and precision stores seconds, so nothing else runs beside it: one after another, whatever waits for what."""


def _runs(commands: tuple[str, ...], jobs: int) -> bool:
    """Whether every command ends well."""
    words = ([sys.executable, *command.format(jobs=jobs).split()] for command in commands)
    return all(subprocess.run(one, cwd=ROOT).returncode == 0 for one in words)


def bring_up_to_date(numbers: Numbers, *, renew: bool, jobs: int) -> bool:
    """Confirm or renew ``numbers``, and say what is done; whether they are fresh now."""
    began = time.perf_counter()
    after = f", after {' and '.join(numbers.waits_for)}" if numbers.waits_for else ""
    if not (renew or any(is_stale(ROOT / PROGRAMS / file) for file in numbers.files)):
        print(f"{numbers.name}: fresh", flush=True)
        return True
    print(f"{numbers.name}: {'made anew' if renew or not numbers.confirm else 'a sample first'}{after} …", flush=True)
    confirmed = not renew and numbers.confirm is not None and _runs((numbers.confirm,), jobs)
    done = confirmed or _runs(numbers.renew, jobs)
    how = "could not be made" if not done else "confirmed" if confirmed else "made anew"
    print(f"{numbers.name}: {how} in {time.perf_counter() - began:.0f} s", flush=True)
    return done


def main() -> int:
    names = [numbers.name for numbers in ALL]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(names)} (default: all)")
    parser.add_argument("--renew", action="store_true", help="make everything anew, fresh or not")
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    if unknown := sorted(set(asked.names) - set(names)):
        parser.error(f"no numbers are called {', '.join(unknown)} (there are {', '.join(names)})")
    lost: set[str] = set()
    for numbers in ALL:
        if asked.names and numbers.name not in asked.names:
            continue
        if missing := lost & set(numbers.waits_for):
            print(f"{numbers.name}: waits for {', '.join(sorted(missing))}")
        elif bring_up_to_date(numbers, renew=asked.renew, jobs=asked.jobs):
            continue
        lost.add(numbers.name)
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())

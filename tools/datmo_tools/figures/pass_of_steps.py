# SPDX-License-Identifier: BSD-3-Clause
"""Runs the jobs of many steps, as many in parallel as there are cores."""

import shutil
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import NamedTuple

from tqdm import tqdm

from datmo_tools.errors import InputError
from datmo_tools.programs import StepFailed

# Expected errors of a job: a program that failed, an unexpected file or figure.
FAILURES = (InputError, StepFailed, OSError, KeyError, TypeError, ValueError)


class Outcome(NamedTuple):
    """The result of one job."""

    step: object
    name: str  # of the job
    result: object = None
    seconds: float = 0.0
    failure: str = ""


def run_steps(steps, bench, store, jobs):
    """Runs the steps that are not done, and stores each one after its last job; those that measure
    time come last, one after the other. Returns the failures as a list of text."""
    todo = [step for step in steps if _is_due(step, bench, store)]
    todo = _unconfirmed(todo, bench, store, jobs)
    side_by_side = [step for step in todo if not step.timed]
    failures = _run(side_by_side, bench, store, jobs)
    for step in todo:
        if step.timed:
            failures += _run([step], bench, store, 1)
    return failures


def _is_due(step, bench, store):
    done_at = store.done_at(step, bench)
    if done_at:
        print(f"{step.name}: done at {done_at}")
        return False
    absent = [name for name in step.needs if not (bench.data / name).exists()]
    for name in absent:
        print(f"{step.name}: left out, {bench.data / name} is not there")
    return not absent


def _unconfirmed(steps, bench, store, jobs):
    """Repeats a job of each step that was affected by a change. Returns the steps whose result of it
    differs, and those without such a job."""
    drawn = {step.name: store.sample_of(step, bench) for step in steps}
    work = [(step, job) for step in steps if drawn[step.name]
            for job in step.jobs(bench) if job.name == drawn[step.name]]  # fmt: skip
    confirmed = set()
    for outcome in _outcomes(work, store, jobs, "samples"):
        step = outcome.step
        if not outcome.failure and store.confirm(step, outcome.name, outcome.result):
            tqdm.write(f"{step.name}: done at {store.done_at(step, bench)}, and {outcome.name} is the same now")
            confirmed.add(step.name)
    return [step for step in steps if step.name not in confirmed]


def _run(steps, bench, store, jobs):
    work = [(step, job) for step in steps for job in step.jobs(bench)]
    outcomes = {step.name: [] for step in steps}
    counts = {name: sum(step.name == name for step, _ in work) for name in outcomes}
    failures = []
    for outcome in _outcomes(work, store, jobs, "jobs"):
        same = outcomes[outcome.step.name]
        same.append(outcome)
        if len(same) == counts[outcome.step.name]:
            failures += _finish(outcome.step, same, bench, store)
    return failures


def _outcomes(work, store, jobs, title):
    """Runs (step, job) pairs, as many in parallel as `jobs`; yields the outcomes as they come."""
    with ThreadPoolExecutor(jobs) as pool:
        running = [pool.submit(_run_job, step, job, store) for step, job in work]
        try:
            for future in tqdm(as_completed(running), title, len(running), disable=not running):
                yield future.result()
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise


def _run_job(step, job, store):
    kept = store.of_job(step, job.name)
    if kept is not None:
        return Outcome(step, job.name, *kept)
    folder = store.folder / "scratch" / step.name / job.name
    shutil.rmtree(folder, ignore_errors=True)
    started = time.monotonic()
    try:
        folder.mkdir(parents=True)
        result, seconds = job.work(folder), time.monotonic() - started
        store.add_job(step, job.name, result, seconds)
        return Outcome(step, job.name, result, seconds)
    except FAILURES as error:
        what = error if isinstance(error, (InputError, StepFailed, OSError)) else repr(error)
        return Outcome(step, job.name, failure=f"{step.name}, {job.name}: {what}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _finish(step, outcomes, bench, store):
    """Stores the step if all its jobs have a result; returns a list of failures."""
    failures = [outcome.failure for outcome in outcomes if outcome.failure]
    if failures:
        return failures
    # In an order that does not depend on the jobs' durations.
    done = {item.name: (item.result, item.seconds) for item in sorted(outcomes, key=lambda item: item.name)}
    store.add(step, step.figures([result for result, _ in done.values()]), done, bench)
    tqdm.write(f"{step.name}: {sum(seconds for _, seconds in done.values()):.0f} s of jobs")
    return []

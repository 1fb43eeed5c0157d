# SPDX-License-Identifier: BSD-3-Clause
"""Sampling: a change that can affect a step, but is not meant to, is checked by repeating one of its jobs."""

import hashlib
import json

DIGITS = 16  # of a digest: a coincidence among all jobs ever made is out of the question


def digest(result):
    """Returns a short text that is the same for equal results of a job."""
    return _hash(json.dumps(result, sort_keys=True))


def drawn(record, commit, names):
    """Returns the name of the job of a step's record (dict) to repeat at a commit, at random, but the
    same one if asked again; None for a step with a single job, which is repeated anyway, and unless
    the record has the digests of just the jobs that the step has now (names: set)."""
    jobs = sorted(record.get("jobs", {}))
    if len(jobs) < 2 or set(jobs) != names:
        return None
    return jobs[int(_hash(f"{commit} {record['shows']}"), 16) % len(jobs)]


def _hash(text):
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:DIGITS]

# SPDX-License-Identifier: BSD-3-Clause
"""Starts a tool that has no program of its own: python3 -m datmo_tools ROOM.TOOL ARGUMENT..."""

import sys

from datmo_tools.launcher import run_tool

if __name__ == "__main__":
    MODULE = sys.argv.pop(1)
    sys.exit(run_tool(MODULE.rpartition(".")[2], MODULE))

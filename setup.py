# SPDX-License-Identifier: BSD-3-Clause
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

rooms = ("batch", "check_bag", "convert", "evaluate", "experiments", "figures")
setup(
    package_data={
        "datmo_tools.batch": ["Snakefile", "profiles/*/config.yaml"],
        "datmo_tools.evaluate": ["report.html"],
        "datmo_tools.experiments": ["*.jinja"],
        "datmo_tools.figures": ["*.jinja"],
    },
    **generate_distutils_setup(
        packages=["datmo_tools", *(f"datmo_tools.{room}" for room in rooms)],
        package_dir={"": "tools"},
    ),
)

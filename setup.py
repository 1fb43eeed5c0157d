from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

rooms = ("check_bag", "convert", "evaluate", "experiments")
packages = ["datmo_tools", *(f"datmo_tools.{room}" for room in rooms)]
setup(**generate_distutils_setup(packages=packages, package_dir={"": "tools"}))

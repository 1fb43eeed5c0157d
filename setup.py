from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

packages = ["datmo_tools", "datmo_tools.check_bag"]
setup(**generate_distutils_setup(packages=packages, package_dir={"": "tools"}))

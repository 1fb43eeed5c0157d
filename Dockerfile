# SPDX-License-Identifier: BSD-3-Clause
# Debian 12:               docker build -t datmo_fusion .
# Ubuntu 20.04, Noetic:    docker build -t datmo_fusion --build-arg BASE=ros:noetic-ros-base-focal .
#   (its base needs CLI11 as well: scripts/packages_ubuntu_20.04.txt)
# docker run --rm -it datmo_fusion: a shell in which rosrun and roslaunch find the package.
ARG BASE=debian:12
FROM ${BASE}

WORKDIR /src/datmo_fusion
# Packages are installed first, so that their layer is reused if only sources change.
COPY scripts/lib.sh scripts/setup scripts/packages_debian_12.txt scripts/packages_ubuntu_20.04.txt scripts/
RUN scripts/setup build run && rm -rf /var/lib/apt/lists/*
COPY . .
RUN scripts/build && cmake --install build --prefix /opt/datmo_fusion && rm -rf build devel

ENTRYPOINT ["/opt/datmo_fusion/env.sh"]
CMD ["bash"]

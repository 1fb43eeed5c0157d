# SPDX-License-Identifier: BSD-3-Clause
# Debian 12:               docker build -t datmo_fusion .
# Ubuntu 20.04, Noetic:    docker build -t datmo_fusion --build-arg BASE=ros:noetic-ros-base-focal .
# docker run --rm -it datmo_fusion: a shell in which rosrun and roslaunch find the package.
ARG BASE=debian:12
FROM ${BASE}

WORKDIR /src/datmo_fusion
# Packages are installed first, so that their layer is reused if only sources change.
COPY scripts/lib.sh scripts/setup scripts/packages_debian_12.txt scripts/packages_ubuntu_20.04.txt scripts/
RUN scripts/setup build run && rm -rf /var/lib/apt/lists/*
# Ubuntu 20.04 has no package of CLI11.
RUN if [ ! -e /usr/include/CLI ]; then \
      apt-get update && apt-get install -y git && rm -rf /var/lib/apt/lists/* && \
      git clone --branch v2.1.2 https://github.com/CLIUtils/CLI11.git /tmp/CLI11 && \
      cmake -S /tmp/CLI11 -B /tmp/CLI11/build -DCLI11_BUILD_TESTS=OFF -DCLI11_BUILD_EXAMPLES=OFF && \
      cmake --install /tmp/CLI11/build && rm -rf /tmp/CLI11; \
    fi
COPY . .
RUN scripts/build && cmake --install build --prefix /opt/datmo_fusion && rm -rf build devel

ENTRYPOINT ["/opt/datmo_fusion/env.sh"]
CMD ["bash"]

# The package, built: docker build -t cabinet_articulation --build-arg SYSTEM=debian:13 .
# SYSTEM is any image of a system that scripts/install_dependencies.sh knows, as ros:noetic-ros-base-focal for Ubuntu 20.04.
ARG SYSTEM=debian:12
FROM $SYSTEM
ENV DEBIAN_FRONTEND=noninteractive
WORKDIR /cabinet_articulation
# What follows is done again only when dependencies change.
COPY package.xml ./
COPY scripts/install_dependencies.sh scripts/
RUN scripts/install_dependencies.sh
COPY . .
RUN scripts/build.sh
ENTRYPOINT ["/bin/bash", "-c", ". devel/setup.bash && exec \"$@\"", "--"]
CMD ["roslaunch", "cabinet_articulation", "demo.launch"]

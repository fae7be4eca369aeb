# Debian packages of the components, by CPack. `deploy/package` builds them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME longreach)
set(CPACK_PACKAGE_CONTACT "longreach maintainers <maintainers@longreach.example>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_SET_DESTDIR ON)               # the configuration is in /etc
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime lab dev mujoco)
if(LONGREACH_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/stage.cmake)

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)

set(CONTROL ${CMAKE_CURRENT_LIST_DIR})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME longreach)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Teleoperation of a robot with haptic devices over a delayed link
longreach lets a person move a distant robot and feel its contacts over a link
with 0 to 10 s of delay, jitter and loss. The robot's side identifies the
stiffness of each contact, and the operator's side renders it with a local,
passive spring at 1 kHz.
.
This package contains the programs of both sides, the client with its page for
the browser, services, robots, scenes, links, and examples of adapters for
devices and robots. Without hardware, `longreach demo` runs both sides with a
simulated operator.")
# Users of the services; libraries that the programs open at run time: gamepads, SpaceMouse, scenes with bodies.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "systemd | systemd-standalone-sysusers | systemd-sysusers")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "libsdl2-2.0-0, libspnav0, libmujoco2.2.2")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "longreach-lab, spacenavd")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CONTROL}/postinst ${CONTROL}/prerm ${CONTROL}/postrm
  ${CONTROL}/conffiles ${CONTROL}/triggers)

set(CPACK_DEBIAN_LAB_PACKAGE_NAME longreach-lab)
set(CPACK_DEBIAN_LAB_DESCRIPTION "Laboratory of longreach: experiments, sweeps, replays in virtual time
longreach-lab runs the programs' own control loops in virtual time:
experiments with metrics and plots, sweeps over parameters on many processors,
replays of recordings, and solvers for kinematics and contacts.")
set(CPACK_DEBIAN_LAB_PACKAGE_DEPENDS "longreach (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LAB_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME longreach-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION "Headers of liblongreach, the library of longreach
For C++ programs that use parts of longreach: identification of contacts, the
passive contact spring, kinematics of robot arms, both sides in virtual time,
and the simulated link. With CMake files and examples.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "longreach (= ${PROJECT_VERSION}), libeigen3-dev")

set(CPACK_DEBIAN_MUJOCO_PACKAGE_NAME longreach-mujoco)
set(CPACK_DEBIAN_MUJOCO_DESCRIPTION "Robots for longreach that MuJoCo simulates
longreach-mujoco serves the robot of an MJCF file, simulated by MuJoCo in real
time, to the slave of longreach like a real robot.")
set(CPACK_DEBIAN_MUJOCO_PACKAGE_DEPENDS "longreach (= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-longreach)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Python package of longreach: laboratory, identification, client
The laboratory of longreach in virtual time, with operator, rendering law,
estimator or robot in Python; the identification of contacts; kinematics of
robot arms; a client of the running programs; recordings as numpy arrays.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "longreach (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib, longreach-lab")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CONTROL}/python/postinst ${CONTROL}/python/prerm)

include(CPack)

# The libraries without ROS that the stages link to: for this package's own build and for packages that find_package() it.
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
if(NOT urdfdom_FOUND)
  # Its key for rosdep is liburdfdom-dev, which catkin_lint does not know.
  #catkin_lint: skip
  find_package(urdfdom REQUIRED)
endif()
if(NOT PROJECT_NAME STREQUAL interpolated_motion_driver)
  list(APPEND interpolated_motion_driver_LIBRARIES fmt::fmt yaml-cpp ${urdfdom_LIBRARIES} Threads::Threads)
endif()

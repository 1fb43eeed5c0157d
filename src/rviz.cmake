# SPDX-License-Identifier: BSD-3-Clause
# Displays and panels for rviz, which a robot without a screen does not need.
if(rviz_FOUND AND Qt5Widgets_FOUND)
  add_library(${PROJECT_NAME}_rviz
    rviz/display_status.cpp
    rviz/driver_painter.cpp
    rviz/other_displays.cpp
    rviz/panels.cpp
    rviz/scene_drawing.cpp
    rviz/tracks_display.cpp
  )
  target_include_directories(${PROJECT_NAME}_rviz SYSTEM PRIVATE ${rviz_INCLUDE_DIRS} ${OGRE_INCLUDE_DIRS})
  target_link_libraries(${PROJECT_NAME}_rviz PRIVATE
    ${PROJECT_NAME}_ros ${rviz_LIBRARIES} ${rviz_DEFAULT_PLUGIN_LIBRARIES} ${roslib_LIBRARIES} Qt5::Widgets)
  datmo_fusion_compile_as_ours(${PROJECT_NAME}_rviz)
  install(TARGETS ${PROJECT_NAME}_rviz LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
  install(FILES ${PROJECT_SOURCE_DIR}/rviz_plugins.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
else()
  message(STATUS "no headers of rviz (Debian: librviz-dev): its displays of ours are not built")
endif()

# SPDX-License-Identifier: BSD-3-Clause
# The stages, read from nodelets.xml: a class `datmo_fusion/NAME` of type `datmo::ClassNodelet` is a
# stage if src/ros/stage/NAME_stage.cpp exists, whose header declares ClassStage. An entry in
# nodelets.xml and the stage's files are therefore sufficient to compile a stage, to export it as a
# nodelet, to run it on a bag and to list its options (doc/development.md).

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/nodelets.xml)

# datmo_fusion_read_stages(NAMES CLASSES [LIBRARY]): returns the names and classes of all stages, or
# of those in one library of nodelets.
function(datmo_fusion_read_stages out_names out_classes)
  file(STRINGS ${PROJECT_SOURCE_DIR}/nodelets.xml lines REGEX "<(library|class) ")
  set(names "")
  set(classes "")
  foreach(line IN LISTS lines)
    if(line MATCHES "<library path=\"lib/lib([^\"]+)\"")
      set(library ${CMAKE_MATCH_1})
    elseif(line MATCHES "name=\"${PROJECT_NAME}/([^\"]+)\" type=\"datmo::([^\"]+)Nodelet\"")
      set(name ${CMAKE_MATCH_1})
      set(class ${CMAKE_MATCH_2})
      if(EXISTS ${PROJECT_SOURCE_DIR}/src/ros/stage/${name}_stage.cpp)
        if("${ARGN}" MATCHES "^(${library})?$")
          list(APPEND names ${name})
          list(APPEND classes ${class})
        endif()
      elseif(NOT EXISTS ${PROJECT_SOURCE_DIR}/src/nodelets/${name}_nodelet.cpp)
        message(FATAL_ERROR "nodelets.xml: ${name}: there is neither src/ros/stage/${name}_stage.cpp nor "
                            "src/nodelets/${name}_nodelet.cpp")
      endif()
    else()
      message(FATAL_ERROR "nodelets.xml: expected a library's path, or a class's name and type, in one line, not: ${line}")
    endif()
  endforeach()
  set(${out_names} ${names} PARENT_SCOPE)
  set(${out_classes} ${classes} PARENT_SCOPE)
endfunction()

# datmo_fusion_stage_sources(OUT LIBRARY): returns the source files of the library's stages,
# relative to src.
function(datmo_fusion_stage_sources out library)
  datmo_fusion_read_stages(names classes ${library})
  list(TRANSFORM names REPLACE "(.+)" "ros/stage/\\1_stage.cpp")
  set(${out} ${names} PARENT_SCOPE)
endfunction()

# datmo_fusion_stage_headers(OUT NAME...): returns the lines that include the headers of the stages.
function(datmo_fusion_stage_headers out)
  set(lines ${ARGN})
  list(TRANSFORM lines REPLACE "(.+)" "#include \"${PROJECT_NAME}/ros/stage/\\1_stage.h\"")
  list(SORT lines)
  list(JOIN lines "\n" text)
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

# datmo_fusion_export_stages(LIBRARY): exports the library's stages as nodelets.
function(datmo_fusion_export_stages library)
  datmo_fusion_read_stages(names classes ${library})
  datmo_fusion_stage_headers(headers ${names})
  set(nodelets "")
  set(exports "")
  foreach(class IN LISTS classes)
    string(APPEND nodelets "using ${class}Nodelet = StageNodelet<${class}Stage>;\n")
    string(APPEND exports "PLUGINLIB_EXPORT_CLASS(datmo::${class}Nodelet, nodelet::Nodelet)\n")
  endforeach()
  set(file ${CMAKE_CURRENT_BINARY_DIR}/nodelets/${library}.cpp)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/stage_nodelets.cpp.in ${file} @ONLY)
  target_sources(${library} PRIVATE ${file})
  target_include_directories(${library} PRIVATE ${PROJECT_SOURCE_DIR}/src/nodelets)
endfunction()

# datmo_fusion_add_stage_list(TARGET): generates stage_list.h, the list of all stages, for targets
# that link TARGET.
function(datmo_fusion_add_stage_list target)
  datmo_fusion_read_stages(names classes)
  datmo_fusion_stage_headers(headers ${names})
  set(visits "")
  foreach(name IN LISTS names)
    list(FIND names ${name} index)
    list(GET classes ${index} class)
    string(APPEND visits "  visit(StageTag<${class}Stage>(), \"${name}\");\n")
  endforeach()
  set(folder ${PROJECT_BINARY_DIR}/stages)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/stage_list.h.in ${folder}/stage_list.h @ONLY)
  add_library(${target} INTERFACE)
  target_include_directories(${target} INTERFACE ${folder})
endfunction()

# SPDX-License-Identifier: BSD-3-Clause
set(DATMO_FUSION_SANITIZE "" CACHE STRING
  "sanitizers: address,undefined or thread; address,undefined,fuzzer-no-link for scripts/fuzz")
if(DATMO_FUSION_SANITIZE)
  add_compile_options(-fsanitize=${DATMO_FUSION_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # These warnings depend on optimization, which sanitizers change: they are shown, but are not
    # errors.
    foreach(warning array-bounds free-nonheap-object maybe-uninitialized null-dereference stringop-overflow)
      add_compile_options(-Wno-error=${warning})
    endforeach()
  endif()
  # Eigen must allocate as in Debian's libpcl, so that memory allocated by one can be freed by the
  # other.
  add_compile_definitions(EIGEN_HAS_CXX17_OVERALIGN=0 EIGEN_MALLOC_ALREADY_ALIGNED=1)
  add_link_options(-fsanitize=${DATMO_FUSION_SANITIZE})
endif()

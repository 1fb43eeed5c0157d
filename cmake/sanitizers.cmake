set(DATMO_FUSION_SANITIZE "" CACHE STRING "sanitizers: address,undefined or thread")
if(DATMO_FUSION_SANITIZE)
  add_compile_options(-fsanitize=${DATMO_FUSION_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${DATMO_FUSION_SANITIZE})
endif()

# Warnings and sanitizers, applied by split_mapf_compile_options(target).
set(SPLIT_MAPF_WARNINGS -Wall -Wextra -Wpedantic)
if(SPLIT_MAPF_WERROR)
  list(APPEND SPLIT_MAPF_WARNINGS -Werror)
endif()
if(SPLIT_MAPF_SANITIZE)
  add_compile_options(-fsanitize=${SPLIT_MAPF_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  if(SPLIT_MAPF_SANITIZE MATCHES thread AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Boost.Asio has a fence that the sanitizer does not model; the warning would be an error.
    add_compile_options(-Wno-tsan)
  endif()
  add_link_options(-fsanitize=${SPLIT_MAPF_SANITIZE})
  add_compile_definitions(SPLIT_MAPF_SANITIZED)  # random tests draw less: test/support/long_run.h
endif()

function(split_mapf_compile_options target)
  target_compile_options(${target} PRIVATE ${SPLIT_MAPF_WARNINGS})
endfunction()

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

include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fno-semantic-interposition SPLIT_MAPF_HAS_OWN_CALLS)

# Has a library call its own functions straight, so that the compiler can put small ones in their place:
# searches consist of them, and without this each of their calls could be led elsewhere by another library.
function(split_mapf_call_own_functions target)
  if(SPLIT_MAPF_HAS_OWN_CALLS AND NOT APPLE AND NOT SPLIT_MAPF_SANITIZE)
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    target_link_options(${target} PRIVATE -Wl,-Bsymbolic-functions)
  endif()
endfunction()

# Writes the C++ file that names a build: version, and a hash of the sources that plans depend on, of the compiler and of
# options. Two processes of the same name find the same plans.
#   cmake -DROOT=. -DOUTPUT=source_hash.cpp -DVERSION=0.1.0 -DFLAVOUR=... -P source_hash.cmake
include(${CMAKE_CURRENT_LIST_DIR}/hashed_sources.cmake)
split_mapf_hashed_sources(${ROOT} sources)
set(all "${FLAVOUR}")
foreach(source IN LISTS sources)
  file(SHA256 ${source} hash)
  file(RELATIVE_PATH name ${ROOT} ${source})
  string(APPEND all "\n${name} ${hash}")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
string(REPLACE "." "_" version ${VERSION})
file(WRITE ${OUTPUT} "#include \"workers/source_hash.h\"

namespace split_mapf {

const char* sourceHash() { return \"${version}-${hash}\"; }

}  // namespace split_mapf
")

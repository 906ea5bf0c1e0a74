# What plans of pieces depend on: who changes one of these files makes another build of them.
function(split_mapf_hashed_sources root sources)
  set(globs ${root}/src/pipeline/piece_*.cpp ${root}/src/pipeline/piece_*.h
    ${root}/include/split_mapf/pipeline/piece_*.h ${root}/src/workers/worker.cpp ${root}/config/cost_model.yaml)
  foreach(room core solvability parallel roadmap io search solver split)
    list(APPEND globs ${root}/src/${room}/*.cpp ${root}/src/${room}/*.h
      ${root}/include/split_mapf/${room}/*.h)
  endforeach()
  file(GLOB_RECURSE found ${globs})
  list(SORT found)
  set(${sources} ${found} PARENT_SCOPE)
endfunction()

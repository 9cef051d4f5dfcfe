# Half of the time of most sources goes into headers and templates that their neighbours take too. The files of a folder
# are therefore compiled a few at a time, in one piece each. Within a folder a name at file scope stands for one thing.
# The preset 'clang' goes without: there each file stands by itself. Who works on a few files turns it off as well.
option(LEKALO_UNITY "Compile the sources of a folder a few at a time" ${PROJECT_IS_TOP_LEVEL})

# lekalo_unite(TARGET MOST sources...): MOST or fewer files at a time. Files with options of their own stay alone, and
# those of lekalo_stands_alone.
function(lekalo_unite TARGET MOST)
  if(NOT LEKALO_UNITY)
    return()
  endif()
  set(folders "")
  foreach(source IN LISTS ARGN)
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH key ${PROJECT_SOURCE_DIR} ${folder})
    string(REPLACE "/" "_" key ${key})
    list(APPEND folders ${key})
    list(APPEND in_${key} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(key IN LISTS folders)
    list(LENGTH in_${key} files)
    math(EXPR groups "(${files} + ${MOST} - 1) / ${MOST}")
    set(at 0)
    foreach(source IN LISTS in_${key})
      math(EXPR group "${at} * ${groups} / ${files}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${key}_${group})
      math(EXPR at "${at} + 1")
    endforeach()
  endforeach()
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# lekalo_stands_alone(sources...): sources of modules that a program may compile itself, before what the library holds.
function(lekalo_stands_alone)
  set_source_files_properties(${ARGN} TARGET_DIRECTORY lekalo_base PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

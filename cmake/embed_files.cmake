# Writes the files of a folder into a C++ source, as a map from their paths to their bytes:
#
#   cmake -DFOLDER=page -DOUTPUT=page_files.cpp -DHEADER=page_files.hpp -DNAMESPACE=lekalo::server -DFUNCTION=page_files
#         [-DPREFIX=/] [-DMISSING=page_missing.html] -P embed_files.cmake
#
# HEADER declares FUNCTION. MISSING stands for index.html where the folder has none, or there is no folder.
cmake_minimum_required(VERSION 3.25)
set(files "")
if(FOLDER)
  file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
endif()
list(SORT files)
set(table "")
set(arrays "")
set(number 0)
macro(embed PATH NAME)
  file(READ ${PATH} hex HEX)
  string(LENGTH "${hex}" digits)
  math(EXPR bytes "${digits} / 2")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," hex "${hex}")
  string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n" hex "${hex}")
  # One byte more, so that an empty file is an array too.
  string(APPEND arrays "const unsigned char file_${number}[] = {\n${hex}0};\n")
  string(APPEND table "    {\"${PREFIX}${NAME}\", {reinterpret_cast<const char*>(file_${number}), ${bytes}}},\n")
  math(EXPR number "${number} + 1")
endmacro()
foreach(file IN LISTS files)
  embed(${FOLDER}/${file} ${file})
endforeach()
if(MISSING AND NOT "index.html" IN_LIST files)
  embed(${MISSING} index.html)
endif()
file(WRITE ${OUTPUT}.new "// Made by cmake/embed_files.cmake.
#include \"${HEADER}\"

namespace ${NAMESPACE} {
namespace {
${arrays}}  // namespace

const std::map<std::string_view, std::string_view>& ${FUNCTION}() {
  static const std::map<std::string_view, std::string_view> files{
${table}  };
  return files;
}

}  // namespace ${NAMESPACE}
")
file(RENAME ${OUTPUT}.new ${OUTPUT})

# Writes the files of a folder into a C++ source: cmake -DFOLDER=page -DOUTPUT=page_files.cpp -P
# embed_page.cmake. Without a folder, one page that says how to build it.
cmake_minimum_required(VERSION 3.25)
set(files "")
if(FOLDER)
  file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*)
endif()
list(SORT files)
set(missing ${CMAKE_CURRENT_LIST_DIR}/page_missing.html)
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
  string(APPEND table "    {\"/${NAME}\", {reinterpret_cast<const char*>(file_${number}), ${bytes}}},\n")
  math(EXPR number "${number} + 1")
endmacro()
foreach(file IN LISTS files)
  embed(${FOLDER}/${file} ${file})
endforeach()
if(NOT "index.html" IN_LIST files)
  embed(${missing} index.html)
endif()
file(WRITE ${OUTPUT}.new "// Made by apps/server/embed_page.cmake.
#include \"page_files.hpp\"

namespace lekalo::server {
namespace {
${arrays}}  // namespace

const std::map<std::string_view, std::string_view>& page_files() {
  static const std::map<std::string_view, std::string_view> files{
${table}  };
  return files;
}

}  // namespace lekalo::server
")
file(RENAME ${OUTPUT}.new ${OUTPUT})

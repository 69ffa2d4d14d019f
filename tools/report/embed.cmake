# Writes a header with text files as string literals: cmake -DOUTPUT=file.h -DNAMES=a;b -DFILES=a.html;b.css -P embed.cmake
set(text "#pragma once\n/// Made by embed.cmake.\n\nnamespace carlo {\n")
foreach(name file IN ZIP_LISTS NAMES FILES)
  file(READ ${file} content)
  string(APPEND text "\ninline constexpr char ${name}[] = R\"__embed__(${content})__embed__\";\n")
endforeach()
file(WRITE ${OUTPUT} "${text}\n} // namespace carlo\n")

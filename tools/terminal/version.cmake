# Writes OUTPUT (a .cpp) with the current commit; keeps the file if the commit is unchanged, so that nothing is rebuilt.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --exclude=*
  OUTPUT_VARIABLE COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(COMMIT unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include <terminal/version.h>
namespace carlo {
const char* const version = "@VERSION@";
const char* const commit = "@COMMIT@";
}
]] @ONLY)

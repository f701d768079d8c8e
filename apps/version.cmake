# Writes Version.cpp with the commit that is built: cmake -DVERSION=... -DSOURCE=... -DTEMPLATE=... -DOUTPUT=... -P version.cmake
# Without git, or without a repository, as in a release's archive, the version stands alone.
if(EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git describe --always --exclude=* --abbrev=10 --dirty WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE status ERROR_QUIET)
  if(status STREQUAL "0")
    string(APPEND VERSION "+${commit}")
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)  # leaves the file alone if nothing changed

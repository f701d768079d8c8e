# params/lidars/*.json -> a source file with their texts and names.
function(scanloom_built_in_models output)
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/params/lidars/*.json)
  set(rows "")
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(READ ${file} text)
    string(JSON name GET "${text}" model)
    string(APPEND rows "    {\"${name}\", R\"json(${text})json\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
#include "input/lidar/BuiltInModels.h"

namespace scanloom
{
std::vector<BuiltInModel> builtInModels()  // NOLINT(readability-function-size): a table
{
  return {
@rows@  };
}
}  // namespace scanloom
]])
endfunction()

// Where models and robot files are.
#pragma once

#include <filesystem>

namespace understudy::config {

// The directory that holds config/robots and models: $UNDERSTUDY_DATA_DIR where that is set, else
// share/understudy beside the program's bin, else the source tree this was built from. Throws
// ConfigError when the variable names no directory or none of them exists.
std::filesystem::path DataDir();

// The same with the environment, the program and the source tree given; `variable` may be null.
std::filesystem::path FindDataDir(const char* variable, const std::filesystem::path& program,
                                  const std::filesystem::path& source);

// The folder of the panel's files, and the document of the control plane's routes: panel/ and
// openapi.yaml in $UNDERSTUDY_DATA_DIR where that is set, else in share/understudy beside the
// program's bin, else in the source tree. They need not exist.
std::filesystem::path PanelDir();
std::filesystem::path OpenApiFile();

}  // namespace understudy::config

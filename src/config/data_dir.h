// Finds the models, the robot files and the files that the server serves.
#pragma once

#include <filesystem>

namespace understudy::config {

// Returns the directory that holds config/robots and models: $UNDERSTUDY_DATA_DIR if it is set,
// else PackageDataDir(), else share/understudy beside the program's bin, else the source tree of
// the build. Throws ConfigError if the variable names a directory without them or if none of the
// others has them.
std::filesystem::path DataDir();

// The same with the variable's value (null if unset), the program, the package's directory and the
// source tree given.
std::filesystem::path FindDataDir(const char* variable, const std::filesystem::path& program,
                                  const std::filesystem::path& package,
                                  const std::filesystem::path& source);

// The data directory of the CMake package with which a program was built
// (docs/reference/embedding.md), or of the Python package; "" if there is none. Change it before
// anything else is called.
std::filesystem::path& PackageDataDir();

#ifdef UNDERSTUDY_PACKAGE_DATA_DIR
inline const bool kHasPackageDataDir = (PackageDataDir() = UNDERSTUDY_PACKAGE_DATA_DIR, true);
#endif

// Return the folder of the panel's files and the OpenAPI document: panel/ and openapi.yaml in
// $UNDERSTUDY_DATA_DIR if it is set, else in share/understudy beside the program's bin. They may
// not exist.
std::filesystem::path PanelDir();
std::filesystem::path OpenApiFile();

}  // namespace understudy::config

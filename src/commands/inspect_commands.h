// `understudy robots`, `check`, `services` and `version`: what needs no running robot.
#pragma once

#include <string>
#include <vector>

namespace understudy::commands {

// Each prints to standard output, as aligned text or as one JSON document, and returns the exit
// code.
int RobotsCommand(bool json);
int VersionCommand(bool json);
int ServicesCommand();  // as Markdown

// Loads each file by its kind: a robot's YAML with its model, a configuration file, an MJCF. Prints
// for each whether it can be used; the exit code is that of the first that cannot.
int CheckCommand(const std::vector<std::string>& files, bool json);

}  // namespace understudy::commands

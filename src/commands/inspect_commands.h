// `understudy robots`, `check`, `services` and `version`: what can be said without running
// anything.
#ifndef UNDERSTUDY_COMMANDS_INSPECT_COMMANDS_H_
#define UNDERSTUDY_COMMANDS_INSPECT_COMMANDS_H_

#include <string>
#include <vector>

namespace understudy::commands {

// Each prints to standard output, as aligned text or as one JSON document, and returns the exit
// code.
int RobotsCommand(bool json);
int VersionCommand(bool json);
int ServicesCommand();  // as Markdown

// Loads each file as what it is: a robot's YAML with its model, a configuration file, an MJCF. Says
// for each whether it is fit to use; the exit code is that of the first that is not.
int CheckCommand(const std::vector<std::string>& files, bool json);

}  // namespace understudy::commands

#endif  // UNDERSTUDY_COMMANDS_INSPECT_COMMANDS_H_

// Where the panel of a robot was, so that a browser's tab of yesterday finds the robot of today.
#pragma once

#include <filesystem>
#include <string>

#include "server/panel_socket.h"

namespace understudy::commands {

// Returns the folder of what runs leave behind: understudy/ in $XDG_STATE_HOME, else in
// ~/.local/state; "" if the environment has neither.
std::filesystem::path StateFolder();

// Returns the file for the panel of robots of that name, "" where there is no folder for it.
std::filesystem::path PanelMemoryFile(const std::string& name);

// Reads what Remember wrote. Returns an empty place unless the file is a regular one of this user
// that nobody else may read, and holds a port and a token.
server::PanelPlace RecallPanel(const std::filesystem::path& file);

// Writes it, for this user alone. Does nothing where it cannot: the next run then has another
// address.
void RememberPanel(const std::filesystem::path& file, const server::PanelPlace& place);

}  // namespace understudy::commands

// Finds the folder of this user's control sockets and names the sockets.
#pragma once

#include <filesystem>
#include <string>

namespace understudy::client {

// Returns the first of these: $UNDERSTUDY_RUNTIME_DIR; understudy/ in $XDG_RUNTIME_DIR if that is a
// folder; understudy/ in /run/user/<uid> if that is this user's; /tmp/understudy-<uid>. It may not
// exist.
std::filesystem::path ControlFolder();

// Returns whether it is the one in /tmp, where nothing is to stay (RemoveControlFolder).
bool IsTransient(const std::filesystem::path& folder);

// Throws SocketError unless `folder` is a folder (not a link) of this user without access for
// others, who could otherwise impersonate a robot.
void CheckControlFolder(const std::filesystem::path& folder);

// Creates `folder`, mode 0700, if it is missing, then checks it as above.
void MakeControlFolder(const std::filesystem::path& folder);

// Returns `<name>.sock` in the control folder. A name is 1 to 64 of A-Z a-z 0-9 . _ -, the first
// not a dot; anything else throws SocketError.
std::filesystem::path ControlSocket(const std::string& name);

// Returns `<robot>-<pid of this process>`, the default name of a robot.
std::string DefaultName(const std::string& robot);

// Throws SocketError if `socket` has more bytes than the address of a Unix socket holds (107).
void CheckSocketPath(const std::filesystem::path& socket);

}  // namespace understudy::client

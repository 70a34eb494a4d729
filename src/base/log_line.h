// The form of what this program says on standard error: text, or one JSON object a line.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace understudy {

// Returns whether a command line asks for JSON: has --json before a --, after which another
// program's begins.
bool AsksForJson(int argc, const char* const* argv);

// Makes all that follows JSON, also what is said when the program ends by a bug. Call it before any
// thread exists.
void SpeakJson();
bool SpeaksJson();

// Returns {"time": s since 1970, "level": ..., "message": ...} and a newline. Bytes that are not
// UTF-8 are replaced, for texts may come from the network.
std::string JsonLogLine(std::chrono::system_clock::time_point time, std::string_view level,
                        std::string_view message);

// Writes an error to standard error: "understudy: <message>", or as JSON.
void SayError(std::string_view message);
// Writes a text of several lines as it is, or as the message of one error.
void SayErrorText(std::string_view text);

}  // namespace understudy

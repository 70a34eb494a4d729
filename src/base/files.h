// Reads and writes whole files, and makes folders.
#pragma once

#include <filesystem>
#include <string>

namespace understudy {

// Returns the content of a file, "" if it cannot be read.
std::string FileText(const std::filesystem::path& file);

// Replaces a file at once, so that nobody finds a part of it. Throws SetupError.
void WriteFile(const std::filesystem::path& file, const std::string& text);

// Makes a folder, and those it is in, unless it is there; returns it. Throws SetupError.
std::filesystem::path MakeFolder(std::filesystem::path folder);

}  // namespace understudy

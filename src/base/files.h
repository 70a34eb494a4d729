// Reads and writes whole files.
#pragma once

#include <filesystem>
#include <string>

namespace understudy {

// Returns the content of a file, "" if it cannot be read.
std::string FileText(const std::filesystem::path& file);

// Replaces a file at once, so that nobody finds a part of it. Throws SetupError.
void WriteFile(const std::filesystem::path& file, const std::string& text);

}  // namespace understudy

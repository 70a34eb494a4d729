// Reads and writes whole files, and makes folders.
#pragma once

#include <filesystem>
#include <string>

namespace understudy {

// Returns the content of a file, "" if it cannot be read.
std::string FileText(const std::filesystem::path& file);

// Replaces a file at once, so that nobody finds a part of it. Throws SetupError.
void WriteFile(const std::filesystem::path& file, const std::string& text);

// Throws RecordError if the file is there and `overwrite` is false, SetupError if WriteFile could
// not write it: it is a folder or a device, or its folder is missing or takes no files.
void CheckWritable(const std::filesystem::path& file, bool overwrite);

// Makes a folder, and those it is in, unless it is there; returns it. Throws SetupError.
std::filesystem::path MakeFolder(std::filesystem::path folder);

}  // namespace understudy

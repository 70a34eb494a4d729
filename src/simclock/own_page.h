// The page of this process, and the library that answers by it.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/unique_fd.h"
#include "simclock/page.h"

namespace understudy::simclock {

// Makes a page, at kFirstInstant and for a robot in this process. Programs inherit the descriptor;
// the page goes with the last of them. `think`: what a program takes from the end of a sleep to its
// next message. Throws SetupError.
UniqueFd MakePage(std::chrono::nanoseconds think);

// Maps it; null: it cannot be had.
Page* MapPage(int file);

// The median of the processor's time that programs on the clock took from the end of a sleep to the
// next message of that thread, 6 % at most too short; nullopt: none has slept and then sent.
std::optional<std::chrono::nanoseconds> MedianComputed(const Page& page);

// The `think` of the page for which this process was started anew; nullopt if it was not, or if
// OwnPage has it already.
std::optional<std::chrono::nanoseconds> ThinkOfStart();

// The words of the command line of this process.
std::vector<std::string> OwnWords();

// A page for the programs that this process starts. Cyclone DDS in this process lives by it too,
// for which the library has to be in it: the first call starts this process anew, with its words
// and number, and does not return.
class OwnPage {
 public:
  // `think` as MakePage has it. Call it before anything else is done. Throws SetupError.
  explicit OwnPage(std::chrono::nanoseconds think);
  ~OwnPage();
  OwnPage(const OwnPage&) = delete;
  OwnPage& operator=(const OwnPage&) = delete;

  Page* get() const { return page_; }
  // What a program needs to take the clock, as ChildProcess has it.
  const std::vector<std::pair<std::string, std::string>>& environment() const {
    return environment_;
  }

 private:
  void Take(int file);

  UniqueFd file_;
  Page* page_ = nullptr;
  std::vector<std::pair<std::string, std::string>> environment_;
};

}  // namespace understudy::simclock

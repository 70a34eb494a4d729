// What a call refuses a user's input with.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "base/errors.h"

namespace understudy::test {

// What the error of `run` says, "" when it throws none. Errors of users are one line.
template <class E = ConfigError, class F>
std::string ErrorOf(F run) {
  try {
    run();
  } catch (const E& e) {
    const std::string what = e.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
  return "";
}

}  // namespace understudy::test

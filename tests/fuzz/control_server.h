// A server with a robot behind it that does nothing, and a client that says what a fuzzer found.
#pragma once

#include <string_view>

namespace understudy::test {

// Sends the bytes on a connection of their own, hangs up, and reads until the server does too.
// Aborts if it takes longer than ten seconds.
void TellServer(std::string_view bytes);

}  // namespace understudy::test

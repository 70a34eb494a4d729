#include "server/access.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <arpa/inet.h>
#include <sys/random.h>

#include "base/errors.h"

namespace understudy::server {
namespace {

std::string Lower(std::string_view text) {
  std::string lower{text};
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return lower;
}

// "127.0.0.1" of "127.0.0.1:7707", "::1" of "[::1]:7707"; "" if anything but a port follows.
std::string NameOf(std::string_view host) {
  const bool bracketed = host.starts_with('[');
  const std::size_t end = bracketed ? host.find(']') : std::min(host.find(':'), host.size());
  if (end == std::string_view::npos) return "";
  const std::string_view port = host.substr(end + (bracketed ? 1 : 0));
  const bool is_port = port.empty() || (port.front() == ':' && port.size() <= 6 &&
                                        port.find_first_not_of("0123456789", 1) == port.npos);
  return is_port ? Lower(host.substr(bracketed ? 1 : 0, end - (bracketed ? 1 : 0))) : "";
}

bool IsAddress(const std::string& name) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  return ::inet_pton(AF_INET, name.c_str(), bytes.data()) == 1 ||
         ::inet_pton(AF_INET6, name.c_str(), bytes.data()) == 1;
}

bool MayBeCalled(const std::string& name, const std::string& bound) {
  if (name == "localhost" || name == "::1" || name == bound) return true;
  if (!IsAddress(name)) return false;
  return name.starts_with("127.") || bound == "0.0.0.0" || bound == "::";
}

// Compares in constant time.
bool Equal(std::string_view given, std::string_view token) {
  if (given.size() != token.size() || token.empty()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < token.size(); ++i) {
    difference |= static_cast<unsigned>(given[i]) ^ static_cast<unsigned>(token[i]);
  }
  return difference == 0;
}

bool NeedsToken(const HttpRequest& request) {
  const std::string_view path = PathOf(request);
  return request.method != "GET" || (path == "/requests" && request.upgrade) || path == "/panel" ||
         path.starts_with("/recordings") || path.starts_with("/cameras/") ||
         path.starts_with("/lidar/");
}

}  // namespace

bool HasToken(const HttpRequest& request, const AccessRules& access) {
  constexpr std::string_view kScheme = "Bearer ";
  if (request.authorization.starts_with(kScheme)) {
    return Equal(request.authorization.substr(kScheme.size()), access.token);
  }
  return request.upgrade && Equal(QueryValue(request, "token").value_or(""), access.token);
}

std::string RandomToken() {
  std::array<std::uint8_t, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw SocketError("the system gives no random numbers for a token");
  }
  constexpr char kDigits[] = "0123456789abcdef";
  std::string token;
  for (const std::uint8_t byte : bytes) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

std::optional<HttpReply> RefusalOf(const HttpRequest& request, const AccessRules& access) {
  if (!MayBeCalled(NameOf(request.host), access.address)) {
    return ErrorReply(403, "Host: expected localhost or " + access.address + ", got \"" +
                               std::string{request.host.substr(0, 64)} + "\"");
  }
  if (!request.origin.empty() && Lower(request.origin) != "http://" + Lower(request.host)) {
    return ErrorReply(403, "Origin: expected that of the panel itself, got \"" +
                               std::string{request.origin.substr(0, 64)} + "\"");
  }
  if (NeedsToken(request) && !HasToken(request, access)) {
    HttpReply reply =
        ErrorReply(401, "this needs the token of the address that the robot says at its start");
    reply.fields.emplace_back("WWW-Authenticate", "Bearer");
    return reply;
  }
  return std::nullopt;
}

}  // namespace understudy::server

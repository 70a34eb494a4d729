#include "exec/private_network.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/capability.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/unique_fd.h"
#include "exec/capabilities.h"
#include "exec/namespace_refusal.h"

namespace understudy::exec {
namespace {

[[noreturn]] void RefuseNetwork(const std::string& step, int error) {
  throw BusError(ExplainRefusal(step, error, NamespacePolicy::OfThisMachine()));
}

// unshare(2) moves only the calling thread: other threads would stay in the old network.
void RequireSingleThread() {
  struct stat tasks {};
  if (::stat("/proc/self/task", &tasks) != 0) RefuseNetwork("reading /proc/self/task", errno);
  const auto threads =
      tasks.st_nlink - 2;  // links of a directory: "." and its name, then one per subfolder
  if (threads > 1) {
    throw BusError("no private network: the process already runs " + std::to_string(threads) +
                   " threads, and only a process of one thread can enter one");
  }
}

// Returns 0 or errno.
int WriteWhole(const char* path, const std::string& text) {
  const UniqueFd file(::open(path, O_WRONLY | O_CLOEXEC));
  if (!file.valid()) return errno;
  // The kernel accepts an id map only in one write.
  return ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) ? 0
                                                                                            : errno;
}

void MapToItself(const char* path, unsigned int id) {
  const std::string name = std::to_string(id);
  if (const int error = WriteWhole(path, name + " " + name + " 1")) {
    RefuseNetwork(std::string("writing ") + path, error);
  }
}

// The caller reads the ids before unshare: in a namespace without a map they are those of nobody.
void MapOwnIds(uid_t uid, gid_t gid) {
  // user_namespaces(7): without privileges, gid_map can be written only after setgroups is denied.
  if (const int error = WriteWhole("/proc/self/setgroups", "deny")) {
    RefuseNetwork("writing /proc/self/setgroups", error);
  }
  MapToItself("/proc/self/uid_map", uid);
  MapToItself("/proc/self/gid_map", gid);
}

UniqueFd OpenControlSocket() {
  UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket.valid()) RefuseNetwork("opening a socket", errno);
  return socket;
}

// The kernel assigns 127.0.0.1/8 to lo when it is set up.
void RaiseLoopback(int socket) {
  ifreq request{};
  std::strcpy(request.ifr_name, "lo");
  if (::ioctl(socket, SIOCGIFFLAGS, &request) != 0) RefuseNetwork("reading the flags of lo", errno);
  request.ifr_flags =
      static_cast<decltype(request.ifr_flags)>(request.ifr_flags | IFF_UP | IFF_MULTICAST);
  if (::ioctl(socket, SIOCSIFFLAGS, &request) != 0) RefuseNetwork("raising lo", errno);
}

sockaddr Ipv4(const char* text) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  ::inet_pton(AF_INET, text, &address.sin_addr);
  sockaddr generic{};
  static_assert(sizeof(generic) == sizeof(address));
  std::memcpy(&generic, &address, sizeof(generic));
  return generic;
}

// Adds the multicast route for programs that name no interface: joining and sending use the routes.
void RouteMulticastToLoopback(int socket) {
  char device[] = "lo";
  rtentry route{};
  route.rt_dst = Ipv4("224.0.0.0");
  route.rt_genmask = Ipv4("240.0.0.0");
  route.rt_flags = RTF_UP;
  route.rt_dev = device;
  if (::ioctl(socket, SIOCADDRT, &route) != 0) RefuseNetwork("adding the multicast route", errno);
}

}  // namespace

void EnterPrivateNetwork() {
  RequireSingleThread();
  const Capabilities before = Capabilities::OfThisThread();
  const uid_t uid = ::geteuid();
  const gid_t gid = ::getegid();

  const bool privileged = before.CanUse(CAP_SYS_ADMIN) && before.CanUse(CAP_NET_ADMIN);
  if (privileged) {
    if (::unshare(CLONE_NEWNET) != 0) RefuseNetwork("creating a network namespace", errno);
  } else {
    // One call for both namespaces, so that a refusal changes nothing.
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) {
      RefuseNetwork("creating a user and a network namespace", errno);
    }
    MapOwnIds(uid, gid);
  }

  const UniqueFd socket = OpenControlSocket();
  RaiseLoopback(socket.get());
  RouteMulticastToLoopback(socket.get());

  // A new user namespace grants every capability. They would override the permissions of the user's
  // files, and uid 0 would gain some at exec, which disables the command's parent-death signal
  // (ChildProcess).
  if (!privileged && !before.Apply())
    RefuseNetwork("giving the namespace's capabilities back", errno);
}

}  // namespace understudy::exec

// SPDX-License-Identifier: Apache-2.0
#include "tests/support/network_namespace.h"

#include <fcntl.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "tests/support/on_a_thread.h"

namespace orbwatch::tests {

namespace {

constexpr const char* kInterface = "wire";

[[noreturn]] void fail_with_errno(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

bool NetworkNamespace::allowed() {
  bool made = false;
  on_a_thread([&made] { made = unshare(CLONE_NEWNET) == 0; });
  return made;
}

NetworkNamespace::NetworkNamespace() {
  on_a_thread([this] {
    if (unshare(CLONE_NEWNET) != 0) fail_with_errno("no network namespace");
    descriptor_ = hal::FileDescriptor(open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC));
    if (!descriptor_.is_open()) fail_with_errno("/proc/thread-self/ns/net");
    ip("link set lo up");
  });
}

void NetworkNamespace::run(const std::function<void()>& work) const {
  on_a_thread([&] {
    if (setns(descriptor_.get(), CLONE_NEWNET) != 0) fail_with_errno("setns");
    work();
  });
}

std::string NetworkNamespace::path() const {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(descriptor_.get());
}

Cable::Cable(const NetworkNamespace& left, const NetworkNamespace& right)
    : left_(left), right_(right) {
  const std::string name(kInterface);
  const auto set_up = [&name](const std::string& address) {
    ip("address add " + address + "/24 dev " + name);
    ip("link set " + name + " up");
  };
  left.run([&] {
    ip("link add " + name + " type veth peer name " + name + " netns " + right.path());
    set_up(kLeft);
  });
  right.run([&] {
    set_up(kRight);
    wait_for_carrier();
  });
  left.run(wait_for_carrier);
}

void Cable::pull() const {
  right_.run([] { ip(std::string("link set ") + kInterface + " down"); });
}

void Cable::plug() const {
  right_.run([] { ip(std::string("link set ") + kInterface + " up"); });
}

void Cable::readdress(const std::string& address) const {
  left_.run([&] {
    const std::string device = std::string(" dev ") + kInterface;
    ip("address flush" + device);
    ip("address add " + address + "/24" + device);
  });
}

void wait_for_carrier() {
  const hal::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  ifreq request{};
  std::strncpy(request.ifr_name, kInterface, sizeof request.ifr_name - 1);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while ((request.ifr_flags & IFF_RUNNING) == 0) {
    if (ioctl(socket.get(), SIOCGIFFLAGS, &request) != 0) fail_with_errno(kInterface);
    if (std::chrono::steady_clock::now() > give_up) throw std::runtime_error("no carrier");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // polls the system
  }
}

void ip(const std::string& arguments) {
  const std::string command = "ip " + arguments;
  // The shell that it starts belongs to this thread's namespace.
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

}  // namespace orbwatch::tests

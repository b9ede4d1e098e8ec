// SPDX-License-Identifier: Apache-2.0
#include "tests/support/lan.h"

namespace orbwatch::tests {
namespace {

std::string port(std::size_t index) { return "port" + std::to_string(index); }

}  // namespace

Lan::Lan(std::size_t computers) {
  switch_.run([] {
    ip("link add bridge type bridge");
    ip("link set bridge up");
  });
  for (std::size_t n = 0; n < computers; ++n) {
    computers_.push_back(std::make_unique<NetworkNamespace>());
    connect(n);
  }
  for (const auto& one : computers_) one->run(wait_for_carrier);
}

void Lan::connect(std::size_t index) const {
  switch_.run([&] {
    ip("link add " + port(index) + " type veth peer name wire netns " + computer(index).path());
    ip("link set " + port(index) + " master bridge up");
  });
  computer(index).run([&] {
    ip("address add " + address(index) + "/24 dev wire");
    ip("link set wire up");
  });
}

void Lan::set(std::size_t index, const std::string& state) const {
  switch_.run([&] { ip("link set " + port(index) + " " + state); });
}

}  // namespace orbwatch::tests

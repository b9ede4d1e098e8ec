// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::tests {

/// A socket of `type` bound to any port of `address`, like those of a GigE camera in this process.
inline hal::FileDescriptor bound_socket(int type, const char* address) {
  hal::FileDescriptor socket(::socket(AF_INET, type | SOCK_CLOEXEC, 0));
  sockaddr_in name{};
  name.sin_family = AF_INET;
  inet_pton(AF_INET, address, &name.sin_addr);
  EXPECT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&name), sizeof name), 0);
  return socket;
}

}  // namespace orbwatch::app::tests

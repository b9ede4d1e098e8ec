// SPDX-License-Identifier: Apache-2.0
#include "hal/acknowledged_bytes.h"

// Those of the kernel have the counter, those of the C library, which exclude them, do not.
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace orbwatch::hal {

std::uint64_t acknowledged_bytes(int socket) {
  tcp_info info{};
  socklen_t size = sizeof info;
  if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
  return info.tcpi_bytes_acked;
}

}  // namespace orbwatch::hal

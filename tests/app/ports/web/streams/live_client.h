// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/ports/web/http_client.h"

namespace orbwatch::app::web::tests {

struct Message {
  nlohmann::json head;
  std::string body;
};

/// A client of /api/v1/live.
class LiveClient {
 public:
  LiveClient(int port, const std::string& target) : client_(port) {
    client_.send(request_text("GET", target));
    head = client_.take_until("\r\n\r\n");
  }

  Message next() {
    Message message{nlohmann::json::parse(client_.take_until("\n")), ""};
    message.body = client_.take(message.head["bytes"]);
    return message;
  }
  Message next(const std::string& kind) {
    for (;;) {
      Message message = next();
      if (message.head["kind"] == kind) return message;
    }
  }

  std::string head;

 private:
  Client client_;
};

}  // namespace orbwatch::app::web::tests

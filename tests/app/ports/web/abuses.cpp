// SPDX-License-Identifier: Apache-2.0
#include "tests/app/ports/web/abuses.h"

#include <array>
#include <random>
#include <stdexcept>
#include <string_view>

#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/access/users.h"
#include "tests/app/ports/web/http_client.h"

namespace orbwatch::app::web::tests {
namespace {

using orbwatch::tests::Abuse;
using orbwatch::tests::begin_crowd;
using orbwatch::tests::Bytes;
using orbwatch::tests::Returning;

constexpr std::string_view kToken = "a-program-that-looks";
const std::string kTokenHeader = "Authorization: Bearer " + std::string(kToken) + "\r\n";

Bytes bytes(std::string_view text) { return {text.begin(), text.end()}; }

/// Requests a stream of pictures and never reads it.
struct AskForStream {
  const Bytes kRequest = bytes(request_text("GET", "/stream.mjpg?view=front", kTokenHeader));
  void operator()(Returning& client) {
    if (!client.is_open()) client.send(kRequest);
  }
};

struct StayConnected {
  void operator()(Returning& client) {
    client.client();
    client.listen();
  }
};

struct SendNoise {
  std::mt19937 random{20261125};
  void operator()(Returning& client) {
    Bytes noise(1 + random() % 2000);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    client.listen();
    if (client.client().send_some(noise) < 0) client.leave();
  }
};

struct AskForFiles {
  void operator()(Returning& client) {
    client.listen();
    client.send(bytes(request_text("GET", "/..%2f..%2f..%2fetc%2fpasswd")));
  }
};

struct SendLongBody {
  void operator()(Returning& client) {
    client.listen();
    client.send(
        bytes("POST /api/v1/login HTTP/1.1\r\nHost: 127.0.0.1\r\n"
              "Content-Length: 999999999\r\n\r\n" +
              std::string(100000, 'x')));
  }
};

struct GuessPasswords {
  void operator()(Returning& client) {
    client.listen();
    client.send(bytes(request_text("POST", "/api/v1/login",
                                   "Content-Type: application/json\r\nX-Orbwatch: page\r\n",
                                   R"({"user": "installer", "password": "not that one"})")));
  }
};

struct Drip {
  void operator()(Returning& client) {
    static const std::string kHead = "GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ";
    client.listen();
    client.send(bytes(client.is_open() ? "x" : kHead));
  }
};

using std::chrono::microseconds;
constexpr std::array kAbuses{
    Abuse{"100 readers that do not read", microseconds(20000), true,
          begin_crowd<AskForStream, 100, 4096>},
    Abuse{"200 connections", microseconds(10000), false, begin_crowd<StayConnected, 200>},
    Abuse{"random bytes", microseconds(500), false, begin_crowd<SendNoise, 4>},
    Abuse{"paths to files", microseconds(500), false, begin_crowd<AskForFiles, 4>},
    Abuse{"bodies without an end", microseconds(1000), false, begin_crowd<SendLongBody, 4>},
    Abuse{"guessed passwords", microseconds(2000), false, begin_crowd<GuessPasswords, 4>},
    Abuse{"slow drip from 200 clients", microseconds(20000), false, begin_crowd<Drip, 200>},
};

}  // namespace

std::string add_users(const std::filesystem::path& state_folder) {
  const auto hash = hash_password("nobody guesses this");
  const auto added = change_users(users_file(state_folder), [&](Users& users) {
    users.users.push_back({"installer", Role::Administrator, hash.value()});
    users.tokens.push_back({"viewer", Role::Viewer, token_hash(kToken)});
    return Result<>();
  });
  if (!added) throw std::runtime_error(added.error().message);
  return kTokenHeader;
}

std::span<const Abuse> abuses() { return kAbuses; }

}  // namespace orbwatch::app::web::tests

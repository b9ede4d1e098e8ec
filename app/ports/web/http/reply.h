// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <microhttpd.h>

#include <memory>

#include "app/ports/web/http/message.h"
#include "app/ports/web/http/stream_sender.h"

/// Answers in the form of libmicrohttpd. Reentrant.
namespace orbwatch::app::web {

struct ReplyDeleter {
  void operator()(MHD_Response* reply) const { ::MHD_destroy_response(reply); }
};
using Reply = std::unique_ptr<MHD_Response, ReplyDeleter>;

/// Makes an answer with its headers, `more` and those of every answer. Null: out of memory.
Reply make_reply(const Response& response, const Values& more);
/// Makes an answer whose body is the data of `sender`, until `on_end` is called.
Reply make_reply(const Response& response, const Values& more, std::shared_ptr<StreamSender> sender,
                 std::function<void()> on_end);

}  // namespace orbwatch::app::web

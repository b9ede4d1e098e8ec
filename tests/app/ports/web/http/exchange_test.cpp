// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/exchange.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace orbwatch::app::web {
namespace {

/// The response to an exchange whose files are not to be sent on.
Response answered_by(Response response) {
  Exchange exchange{Request{}};
  exchange.send_file_while([] { return false; });
  EXPECT_TRUE(exchange.answer(std::move(response)));
  return exchange.response_or_suspend(nullptr).value();
}

TEST(Exchange, AFileIsSentUnderTheConditionOfItsRequest) {
  Response file = file_response(kText, std::make_shared<const OpenFile>());
  const Response sent = answered_by(file);
  ASSERT_TRUE(sent.may_go_on != nullptr);
  EXPECT_FALSE(sent.may_go_on());
  file.may_go_on = [] { return true; };
  EXPECT_TRUE(answered_by(file).may_go_on()) << "its own condition";
}

/// Such as the one to a logout.
TEST(Exchange, AnotherAnswerIsSentToItsEnd) {
  EXPECT_TRUE(answered_by(json_response("{}")).may_go_on == nullptr);
}

}  // namespace
}  // namespace orbwatch::app::web

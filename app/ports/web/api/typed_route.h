// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/api/route.h"

/// Routes from handlers: a handler's parameters and result are records, from which its request is
/// parsed before it runs, its answer is written, and both are described.
namespace orbwatch::app::web {

/// @name Types of a handler: a member function without arguments or with a record, which may also
/// take the Request, or the ExchangePtr that it then answers itself.
/// @{
template <class Handler>
struct HandlerOf;
template <class Owner_, class Result_, class... Parameters>
struct HandlerOf<Result_ (Owner_::*)(Parameters...)> {
  using Owner = Owner_;
  using Answer = Result_;
  template <class T>
  static constexpr bool kIsRecord = !std::is_same_v<T, Request> && !std::is_same_v<T, ExchangePtr>;
  template <class... None>
  struct RecordIn {
    using type = Nothing;
  };
  template <class First, class... Others>
  struct RecordIn<First, Others...> {
    using type = typename std::conditional_t<kIsRecord<First>, std::type_identity<First>,
                                             RecordIn<Others...>>::type;
  };
  using Arguments = typename RecordIn<std::remove_cvref_t<Parameters>...>::type;

  template <class Parameter>
  static const auto& argument(const ExchangePtr& exchange, const Arguments& arguments) {
    using T = std::remove_cvref_t<Parameter>;
    if constexpr (std::is_same_v<T, ExchangePtr>) {
      return exchange;
    } else if constexpr (std::is_same_v<T, Request>) {
      return exchange->request();
    } else {
      return arguments;
    }
  }
  template <auto handler>
  static Answer call(Owner& owner, const ExchangePtr& exchange, const Arguments& arguments) {
    return (owner.*handler)(argument<Parameters>(exchange, arguments)...);
  }
};
template <class Owner, class Result, class... Parameters>
struct HandlerOf<Result (Owner::*)(Parameters...) const>
    : HandlerOf<Result (Owner::*)(Parameters...)> {};
/// @}

template <class T>
inline constexpr bool kIsAnswered = false;
template <class T>
inline constexpr bool kIsAnswered<Answered<T>> = true;

/// Response with a record as JSON.
template <class Record>
Response response_of(Answered<Record> answered) {
  return answered ? json_response(json_text(json_of(*answered))) : std::move(answered.error());
}
inline Response response_of(Response response) { return response; }

/// Route of a handler that changes nothing. `owner` outlives it; null: the route is only described.
/// `type` is the media type of a handler that answers itself or returns a Response; `Described` is
/// the record that it answers as JSON.
template <auto handler, class Described = void, class Owner>
Route get(std::string_view path, Role role, Owner* owner, std::string_view description,
          std::string_view type = kJson) {
  using Types = HandlerOf<decltype(handler)>;
  using Arguments = typename Types::Arguments;
  Route route{"GET", std::string(path), role, std::string(description), std::string(type)};
  if constexpr (!std::is_same_v<Arguments, Nothing>) {
    route.query = schema_of<Arguments, Sent::ByClient>;
  }
  if constexpr (kIsAnswered<typename Types::Answer>) {
    route.answer = schema_of<typename Types::Answer::value_type, Sent::ByUs>;
  } else if constexpr (!std::is_void_v<Described>) {
    route.answer = schema_of<Described, Sent::ByUs>;
  }
  route.serve = [owner, query = route.query](const ExchangePtr& exchange) {
    const auto sent = query ? parse_query(exchange->request(), query()) : Json::object();
    const auto arguments = sent.and_then(record_of<Arguments>);
    if (!arguments) {
      exchange->answer(error_response(400, arguments.error().message));
    } else if constexpr (std::is_void_v<typename Types::Answer>) {
      Types::template call<handler>(*owner, exchange, *arguments);
    } else {
      exchange->answer(response_of(Types::template call<handler>(*owner, exchange, *arguments)));
    }
  };
  return route;
}

/// @name Types of a handler of changes: Answered<Answer> (Owner::*)(Change<Body>&).
/// @{
template <class Handler>
struct ChangeHandlerOf;
template <class Owner_, class Answer_, class Body_>
struct ChangeHandlerOf<Answered<Answer_> (Owner_::*)(Change<Body_>&)> {
  using Answer = Answer_;
  using Body = Body_;
};
template <class Owner, class Answer, class Body>
struct ChangeHandlerOf<Answered<Answer> (Owner::*)(Change<Body>&) const>
    : ChangeHandlerOf<Answered<Answer> (Owner::*)(Change<Body>&)> {};
/// @}

/// Route of a handler that changes something: it runs on the thread of `changes`, and is recorded
/// in the audit. `refusal` is asked on the server's thread for the refusal of a client without a
/// role, independent of the secret that it sends; null: none is refused at once.
template <auto handler, auto refusal = nullptr, class Owner>
Route post(std::string_view path, Role role, Owner* owner, Changes* changes,
           std::string_view description) {
  using Types = ChangeHandlerOf<decltype(handler)>;
  using Body = typename Types::Body;
  Route route{"POST", std::string(path), role, std::string(description), std::string(kJson)};
  route.body = schema_of<Body, Sent::ByClient>;
  route.answer = schema_of<typename Types::Answer, Sent::ByUs>;
  route.serve = [owner, changes, role](const ExchangePtr& exchange) {
    auto body = parse_record<Body>(exchange->request().body);
    if (!body) {
      exchange->answer(error_response(400, body.error().message));
      return;
    }
    const auto change = std::make_shared<Change<Body>>(exchange->request(), std::move(*body));
    if constexpr (!std::is_null_pointer_v<decltype(refusal)>) {
      if (const auto refused = (owner->*refusal)(*change)) {
        exchange->answer(changes->refuse_unknown(*change, *refused));
        return;
      }
    }
    changes->run(exchange, change, role,
                 [owner, change] { return response_of((owner->*handler)(*change)); });
  };
  return route;
}

}  // namespace orbwatch::app::web

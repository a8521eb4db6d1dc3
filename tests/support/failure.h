// What an action that must fail says of it.
#pragma once

#include "core/report/error.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace quell::test {

// The message of the exception that the action ends in; its exit code must be this where it is an Error.
template <class Action>
std::string failure(std::optional<Exit> exit, Action action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_TRUE(!exit || e.exit() == *exit) << e.what();
    return e.what();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

template <class Action>
std::string failure(Action action) {
  return failure(std::nullopt, action);
}

}  // namespace quell::test

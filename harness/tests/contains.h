// Defines the assertion contains(): a text or JSON string contains another one. The failure
// message shows both.
#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include <evalcts/results/json.h>

namespace evalcts {

template <class T>
std::string_view view_of(const T& text) {
  if constexpr (Json<T>) {
    return as_text(text);
  } else {
    return text;
  }
}

template <class Whole, class Part>
testing::AssertionResult contains(const Whole& whole, const Part& part) {
  const std::string_view text = view_of(whole), wanted = view_of(part);
  const bool found = text.find(wanted) != std::string_view::npos;
  return testing::AssertionResult(found)
         << '"' << wanted << (found ? "\" is in: " : "\" is not in: ") << text;
}

}  // namespace evalcts

// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// A table that is made when it is first asked for, as most bodies never need theirs.
#pragma once
#include <memory>
#include <mutex>

namespace ofg {

// What it is made of must not change. Copies share it, and several threads may ask.
template <class Table>
class OnDemand {
 public:
  template <class Make>
  const Table& get(Make make) const {
    std::call_once(state->once, [&] { state->table = make(); });
    return state->table;
  }

 private:
  struct State {
    std::once_flag once;
    Table table;
  };
  std::shared_ptr<State> state = std::make_shared<State>();
};

}  // namespace ofg

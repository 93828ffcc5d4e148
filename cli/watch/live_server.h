// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "cli/watch/live_log.h"

namespace throng::cli {

/// Shows a log to browsers on this machine: `/` is the page, `/crowd` all messages so far and then whatever
/// comes. There is nothing else to ask for, and other machines and other sites' pages get nothing.
class LiveServer {
  public:
    /// @param log outlives this; @param page HTML; @param port 0: any that is free
    /// @throws OutputError where the port is taken
    LiveServer(const LiveLog& log, std::string page, int port);
    /// The log has to be closed before.
    ~LiveServer();
    LiveServer(const LiveServer&) = delete;
    LiveServer& operator=(const LiveServer&) = delete;

    int port() const;
    /// For a browser.
    std::string address() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace throng::cli

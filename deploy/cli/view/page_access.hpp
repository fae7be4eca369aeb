#pragma once
// Access control of the view server. Pure. A page of another site cannot use this server: neither under its
// own name that resolves to this host (Host), nor by a WebSocket from there (Origin). Every path begins with
// a token, also on loopback, which other users of this machine share. The token is in the path, since a
// cookie would be sent to every port of the host, including those of other users.

#include <string>
#include <string_view>
#include <vector>

namespace longreach {

struct PageAccess {
  std::string token;               // first part of every path; empty: no access
  std::vector<std::string> hosts;  // names and port of this server; empty: any
};

/// The head of a request; missing parts are empty.
struct ViewRequest {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  std::string_view origin;
  bool upgrade = false;  // to a WebSocket
};

enum class ViewAnswer { kPage, kScript, kStyle, kLive, kForbidden, kNotFound, kNotAllowed };

ViewAnswer answer(const PageAccess& access, const ViewRequest& request);
/// Returns whether the answer implies that the token was correct.
bool is_let_in(ViewAnswer answer);

/// The names of a server on loopback for browsers.
std::vector<std::string> loopback_hosts(int port);

/// Returns 130 random bits as letters and digits.
std::string draw_token();

}  // namespace longreach

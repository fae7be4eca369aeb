#pragma once
// Who may have what of the view's server. Pure. A page of another site cannot use this server: neither under
// a name of its own that leads here (Host), nor by a WebSocket from there (Origin). Every path begins with a
// token, on loopback too: other users of this machine have a loopback as well. It stays in the path, since a
// cookie would go to every port of the host, those of other users included.

#include <string>
#include <string_view>
#include <vector>

namespace longreach {

struct PageAccess {
  std::string token;               // first part of every path; empty: nobody gets in
  std::vector<std::string> hosts;  // names and port that lead here; empty: any
};

/// The head of a request; what is absent is empty.
struct ViewRequest {
  std::string_view method;
  std::string_view target;
  std::string_view host;
  std::string_view origin;
  bool upgrade = false;  // to a WebSocket
};

enum class ViewAnswer { kPage, kScript, kStyle, kLive, kForbidden, kNotFound, kNotAllowed };

ViewAnswer answer(const PageAccess& access, const ViewRequest& request);
/// Whether the answer shows that the token was right.
bool is_let_in(ViewAnswer answer);

/// The names under which a server on loopback is known to browsers.
std::vector<std::string> loopback_hosts(int port);

/// 130 random bits, in letters and digits.
std::string draw_token();

}  // namespace longreach

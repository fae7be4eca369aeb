#include "deploy/cli/view/page_access.hpp"

#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <optional>
#include <stdexcept>

namespace longreach {
namespace {

bool equal_names(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// Compares in constant time.
bool equal_secrets(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

/// Returns the path after the token, with its slash, or std::nullopt if the token is wrong.
std::optional<std::string_view> behind_token(const std::string& token, std::string_view path) {
  if (token.empty() || !path.starts_with('/')) return std::nullopt;
  path.remove_prefix(1);
  const std::string_view given = path.substr(0, path.find('/'));
  if (!equal_secrets(given, token)) return std::nullopt;
  return path.substr(given.size());
}

bool own_origin(const ViewRequest& request) {
  // Browsers always send the origin of a script; other programs need not.
  if (request.origin.empty()) return true;
  constexpr std::string_view kScheme = "http://";
  return request.origin.starts_with(kScheme) &&
         equal_names(request.origin.substr(kScheme.size()), request.host);
}

}  // namespace

ViewAnswer answer(const PageAccess& access, const ViewRequest& request) {
  const auto is_host = [&](const std::string& name) { return equal_names(name, request.host); };
  if (!access.hosts.empty() && std::none_of(access.hosts.begin(), access.hosts.end(), is_host))
    return ViewAnswer::kForbidden;
  const auto path = behind_token(access.token, request.target.substr(0, request.target.find('?')));
  if (!path || !own_origin(request)) return ViewAnswer::kForbidden;
  if (request.method != "GET") return ViewAnswer::kNotAllowed;
  if (*path == "/live") return request.upgrade ? ViewAnswer::kLive : ViewAnswer::kNotAllowed;
  if (*path == "/") return ViewAnswer::kPage;
  if (*path == "/view.js") return ViewAnswer::kScript;
  if (*path == "/view.css") return ViewAnswer::kStyle;
  return ViewAnswer::kNotFound;
}

bool is_let_in(ViewAnswer answer) { return answer != ViewAnswer::kForbidden; }

std::vector<std::string> loopback_hosts(int port) {
  const std::string end = ":" + std::to_string(port);
  return {"127.0.0.1" + end, "localhost" + end, "[::1]" + end};
}

std::string draw_token() {
  std::array<std::uint8_t, 26> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system provides no random numbers for the page token");
  // 5 bits per letter.
  std::string token;
  for (const std::uint8_t byte : bytes) token += "abcdefghijkmnpqrstuvwxyz23456789"[byte % 32];
  return token;
}

}  // namespace longreach

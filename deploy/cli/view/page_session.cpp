#include "deploy/cli/view/page_session.hpp"

#include "deploy/cli/view/view_page.hpp"

namespace longreach {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;

constexpr auto kRequestTimeout = std::chrono::seconds(5);
constexpr auto kAnswerTimeout = std::chrono::seconds(30);  // for sending the files over a slow network
constexpr std::uint32_t kHeadMaxBytes = 8192;

http::response<http::string_body> plain(http::status status, std::string_view text) {
  http::response<http::string_body> out(status, 11);
  out.set(http::field::content_type, "text/plain; charset=utf-8");
  out.body() = text;
  return out;
}

http::response<http::string_body> response_to(ViewAnswer answer) {
  const ViewPage page = view_page();
  const auto file = [](std::string_view content, const char* type) {
    auto out = plain(http::status::ok, content);
    out.set(http::field::content_type, type);
    return out;
  };
  switch (answer) {
    case ViewAnswer::kPage:
      return file(page.html, "text/html; charset=utf-8");
    case ViewAnswer::kScript:
      return file(page.script, "text/javascript; charset=utf-8");
    case ViewAnswer::kStyle:
      return file(page.style, "text/css; charset=utf-8");
    case ViewAnswer::kNotFound:
      return plain(http::status::not_found, "this page does not exist\n");
    case ViewAnswer::kNotAllowed:
    case ViewAnswer::kLive:
      return plain(http::status::method_not_allowed,
                   "only GET requests, and a WebSocket at /live, are supported\n");
    case ViewAnswer::kForbidden:
      break;
  }
  return plain(http::status::forbidden,
               "The token in this address is missing or outdated. Open the complete address that longreach "
               "view printed when it was\nlast started: the token changes with every start.\n");
}

std::string_view field(const ViewHttpRequest& request, http::field name) {
  const auto value = request[name];
  return {value.data(), value.size()};
}

ViewAnswer judge(const PageAccess& access, const ViewHttpRequest& request) {
  const auto method = request.method_string();
  const auto target = request.target();
  return answer(access, {.method = {method.data(), method.size()},
                         .target = {target.data(), target.size()},
                         .host = field(request, http::field::host),
                         .origin = field(request, http::field::origin),
                         .upgrade = beast::websocket::is_upgrade(request)});
}

}  // namespace

PageSession::PageSession(boost::asio::ip::tcp::socket socket, const PageAccess& access,
                         Viewer::Backend backend, std::shared_ptr<void> slot)
    : stream_(std::move(socket)),
      access_(access),
      backend_(std::move(backend)),
      slot_(std::move(slot)),
      buffer_(2 * kHeadMaxBytes) {}

void PageSession::read() {
  parser_.emplace();
  parser_->header_limit(kHeadMaxBytes);
  parser_->body_limit(0);
  stream_.expires_after(kRequestTimeout);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) {
                     if (!error) self->on_request();
                   });
}

void PageSession::on_request() {
  const ViewHttpRequest request = parser_->release();
  const ViewAnswer answer = judge(access_, request);
  let_in_ = is_let_in(answer);
  if (answer == ViewAnswer::kLive) {
    backend_.opened = [opened = backend_.opened, slot = slot_](const auto& viewer) { opened(viewer); };
    std::make_shared<Viewer>(std::move(stream_), std::move(backend_))->accept(request);
    return;
  }
  response_ = response_to(answer);
  response_.set(http::field::cache_control, "no-store");
  response_.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set("Referrer-Policy", "no-referrer");
  response_.keep_alive(let_in_ && request.keep_alive());
  response_.prepare_payload();
  if (let_in_) stream_.expires_after(kAnswerTimeout);
  http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (!error && self->response_.keep_alive()) self->read();
  });
}

}  // namespace longreach

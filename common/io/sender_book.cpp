#include "common/io/sender_book.hpp"

#include <algorithm>

namespace longreach {

void SenderBook::note(const Header& header, const asio::ip::udp::endpoint& sender) {
  if (header.session == 0) return;
  const auto same = [&header](const Entry& e) { return e.session == header.session; };
  auto entry = std::find_if(entries_.begin(), entries_.end(), same);
  if (entry == entries_.end()) {
    entry = std::min_element(entries_.begin(), entries_.end(),
                             [](const Entry& a, const Entry& b) { return a.heard < b.heard; });
    *entry = Entry{};
  }
  entry->heard = ++notes_;
  if (entry->session == header.session && header.sequence <= entry->sequence) return;
  entry->session = header.session;
  entry->sequence = header.sequence;
  entry->sender = sender;
}

std::optional<asio::ip::udp::endpoint> SenderBook::find(std::uint64_t session) const {
  if (session == 0) return std::nullopt;
  for (const Entry& e : entries_) {
    if (e.session == session) return e.sender;
  }
  return std::nullopt;
}

}  // namespace longreach

#include "deploy/cli/adapter/adapter_checks.hpp"

#include <sched.h>
#include <unistd.h>

#include <limits>

#include "deploy/cli/adapter/adapter_conversation.hpp"
#include "deploy/cli/adapter/adapter_subject.hpp"

namespace longreach {
namespace {

constexpr double kLeast_hz = 500.0, kMost_hz = 4400.0;
constexpr double kLongGap_s = 0.005;  // one gap out of a hundred may be longer
constexpr double kWatchdog_s = 0.02;
constexpr double kMargin_s = 0.01;  // tolerance for transport and clock

template <class Subject>
class AdapterCheck {
 public:
  using In = typename Subject::In;
  using Out = typename Subject::Out;
  using Talk = Conversation<Out, In>;
  using Seen = std::vector<typename Talk::Seen>;

  AdapterCheck(const std::string& address, Subject subject)
      : address_(address),
        subject_(subject),
        talk_(std::in_place, address, static_cast<std::uint64_t>(AdapterSocket::now_ns())) {}

  Section run() {
    // Real-time priority, so that measured delays are those of the adapter. Without the permission, the
    // result depends on the load of the machine.
    const sched_param priority{.sched_priority = 30};
    sched_setscheduler(0, SCHED_FIFO, &priority);
    section_.title = std::string(Subject::kWhat) + " adapter at " + address_;
    if (meet()) {
      private_to_the_user();
      watch();
      obeys();
      ignores();
      rests();
      goes_on();
      restarts();
      talk_->talk(0.05, [this](double) { return subject_.nothing(); });
      talk_.reset();
      knows_its_peer();
    }
    return std::move(section_);
  }

 private:
  void add(bool ok, const char* what, std::string text, std::string advice) {
    section_.findings.push_back({ok ? FindingVerdict::kOk : FindingVerdict::kFailure,
                                 what,
                                 std::move(text),
                                 ok ? "" : std::move(advice),
                                 {}});
  }

  [[nodiscard]] std::string wrong() const {
    std::string text;
    for (const auto& [why, times] : talk_->wrong())
      text += (text.empty() ? "" : "; ") + std::to_string(times) + " times " + why;
    return text;
  }

  bool meet() {
    Seen seen;
    for (int i = 0; i < 20 && seen.empty(); ++i)
      seen = talk_->talk(0.1, [this](double) { return subject_.nothing(); });
    if (!seen.empty()) {
      subject_.know(seen.back().in);
      add(true, "answers", std::string("with ") + Subject::kSends, "");
      return true;
    }
    const std::string trouble = talk_->socket().trouble();
    if (!trouble.empty()) {
      add(false, "answers", "cannot connect to the adapter: " + trouble,
          "start the adapter, and give the path of its socket");
    } else if (talk_->wrong().empty()) {
      add(false, "answers", "no datagram arrived within 2 s",
          "start the adapter; it must send datagrams while a program is connected");
    } else {
      add(false, "answers",
          "a received datagram is not a valid " + std::string(Subject::kSends) + ": " + wrong(),
          "compare its layout with common/link/adapter_datagram.hpp");
    }
    return false;
  }

  void private_to_the_user() {
    const bool open = talk_->socket().open_to_others();
    add(!open, "access", open ? "other users can connect to its socket" : "other users cannot connect",
        "create the socket with umask 077 or set its mode to 0600, and close connections of other users");
  }

  /// Runs after this end has disconnected, because an adapter accepts one program at a time. The datagrams
  /// command nothing.
  void knows_its_peer() {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() != 0) return;
    Talk unknown_peer(address_, static_cast<std::uint64_t>(AdapterSocket::now_ns()), kNobody);
    const bool answers = !unknown_peer.talk(0.3, [this](double) { return subject_.nothing(); }).empty();
    add(!answers, "peer",
        answers ? "it responds to a program of another user (uid 65534)"
                : "does not respond to a program of another user",
        "call getsockopt(SO_PEERCRED) after accept(), and close the connection unless the peer is the "
        "adapter's own user or root");
  }

  /// Checks for two seconds what must hold for every datagram.
  void watch() {
    const Seen seen = talk_->talk(2.0, [this](double) { return subject_.nothing(); });
    add(talk_->wrong().empty(), "layout", talk_->wrong().empty() ? "every datagram is valid" : wrong(),
        "compare its layout with common/link/adapter_datagram.hpp; send 0 for an unknown value, and clear kOk");
    judge_rate(seen);
    judge_sequence();
    report_bodies();
    const bool works = std::ranges::all_of(seen, [](const auto& s) { return (s.in.flags & In::kOk) != 0; });
    add(works, "works",
        works ? "every datagram sets kOk" : "it reports a failure: some datagrams do not set kOk",
        "set kOk while the hardware works");
    for (const auto& one : seen) subject_.watch(one.at_ns, one.in);
    for (Finding& finding : subject_.findings()) section_.findings.push_back(std::move(finding));
  }

  void judge_rate(const Seen& seen) {
    std::vector<double> gaps_s;
    for (std::size_t i = 1; i < seen.size(); ++i)
      gaps_s.push_back(1e-9 * static_cast<double>(seen[i].at_ns - seen[i - 1].at_ns));
    std::ranges::sort(gaps_s);
    const double hz = static_cast<double>(seen.size()) / 2.0;
    const double p99_s = gaps_s.empty() ? 2.0 : gaps_s[gaps_s.size() * 99 / 100];
    const double longest_s = gaps_s.empty() ? 2.0 : gaps_s.back();
    const std::string text =
        in_text("%.0f datagrams/s", hz) + in_text(", 99 %% of the gaps are at most %.1f ms", 1e3 * p99_s);
    add(hz >= kLeast_hz && hz <= kMost_hz && p99_s <= kLongGap_s, "rate", text,
        "send 500 to 4000 datagrams per second at a constant rate: use real-time priority and absolute "
        "deadlines");
    add(true, "longest gap", in_text("%.1f ms", 1e3 * longest_s), "");
    if (longest_s < kWatchdog_s) return;
    section_.findings.back().verdict = FindingVerdict::kWarning;
    section_.findings.back().advice = "longreach puts the robot on hold if no datagram arrives for 20 ms";
  }

  void judge_sequence() {
    std::string trouble;
    const std::vector<adapter::Header>& seen = talk_->headers();
    for (std::size_t i = 1; i < seen.size() && trouble.empty(); ++i) {
      const adapter::Header &before = seen[i - 1], &h = seen[i];
      if (h.session != before.session) trouble = "the session number changed during the run";
      if (h.sequence != before.sequence + 1)
        trouble =
            "sequence number " + std::to_string(h.sequence) + " follows " + std::to_string(before.sequence);
    }
    add(trouble.empty(), "sequence",
        trouble.empty() ? "increases by one per datagram, within one session" : trouble,
        "choose a random session number once, at the start, and increase the sequence number by one "
        "per datagram");
    const std::uint64_t echo = seen.empty() ? 0 : seen.back().echo;
    const bool follows = echo <= talk_->sent() && echo + 100 > talk_->sent();
    add(follows, "echo",
        follows
            ? "is the number of a recent datagram"
            : "is " + std::to_string(echo) + " after " + std::to_string(talk_->sent()) + " sent datagrams",
        "echo the sequence number of the newest accepted datagram");
  }

  /// Says how many free bodies the robot tracks, if it sends their poses.
  void report_bodies() {
    const auto& bodies = talk_->bodies();
    if (!bodies) return;
    const auto known = std::count_if(bodies->body, bodies->body + bodies->count,
                                     [](const adapter::TrackedBody& one) { return one.age_s >= 0.0; });
    const std::string count = std::to_string(bodies->count);
    add(true, "bodies",
        "tracks " + count + (bodies->count == 1 ? " free body" : " free bodies") +
            (known < bodies->count ? ", with a known pose: " + std::to_string(known) : ""),
        "");
  }

  void obeys() {
    const Seen seen = ask(Subject::kSettle_s);
    const bool does = !seen.empty() && subject_.does(seen.back().in);
    add(does, Subject::kAsk,
        does ? "follows the command: " + subject_.asked()
             : "commanded to " + subject_.asked() + ", but " + said(seen),
        subject_.advice());
  }

  /// Checks that invalid datagrams are ignored. Each kind is sent in addition to the valid datagrams.
  void ignores() {
    using Corruption = std::function<void(Out&)>;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto number = [](Out& out) -> double& {
      if constexpr (requires { out.force_n; })
        return out.force_n[0];
      else
        return out.joint_rad[0];
    };
    const std::pair<const char*, Corruption> kinds[] = {
        {"a wrong magic", [](Out& o) { o.header.magic[3] = 'X'; }},
        {"a wrong version", [](Out& o) { o.header.version = 9; }},
        {"a wrong kind", [](Out& o) { o.header.kind = 77; }},
        {"a wrong size in the header", [](Out& o) { o.header.size = 1; }},
        {"session 0", [](Out& o) { o.header.session = 0; }},
        {"a non-finite number", [&number](Out& o) { number(o) = kNone; }},
        {"an old sequence number", [](Out& o) { o.header.sequence = 1; }},
        {"another program's session", [](Out& o) { o.header.session ^= 0x5555U; }},
    };
    std::string taken;
    const auto corrupted = [&](const char* what, const typename Talk::Beside& beside) {
      if (!taken.empty()) return;
      const Seen seen = ask(0.06, beside);
      const bool fine = !seen.empty() && std::ranges::all_of(seen, [this](const auto& s) {
        return s.excused || subject_.does(s.in);
      });
      if (!fine) taken = std::string("it accepts ") + what + ": " + said(seen);
    };
    for (const auto& [what, mark_affected] : kinds)
      corrupted(what, [&, &mark_affected = mark_affected](const AdapterSocket& socket, const Out& meant) {
        Out out = subject_.poison(meant);
        out.header.sequence += 1'000'000;
        mark_affected(out);
        socket.send(std::as_bytes(std::span(&out, 1)));
      });
    corrupted("random bytes", [this](const AdapterSocket& socket, const Out& meant) {
      std::array<std::byte, 1400> bytes{};
      for (auto& b : bytes) b = static_cast<std::byte>(talk_->random().next());
      const Out poison = subject_.poison(meant);
      if (talk_->random().chance(0.5)) std::memcpy(bytes.data(), &poison, sizeof poison);
      // A datagram of 0 bytes would end the connection.
      std::size_t size = 1 + talk_->random().next() % (bytes.size() - 1);
      if (size == sizeof poison) ++size;
      socket.send(std::span(bytes).first(size));
    });
    add(taken.empty(), "garbage", taken.empty() ? "ignores invalid datagrams" : taken,
        "check the size, magic, version, kind, session and sequence number, and check that every "
        "value is finite (rules 1 and 3)");
  }

  void rests() {
    ask(0.1);
    const std::int64_t last_ns = talk_->last_sent_ns();
    const Seen seen = talk_->talk(0.6, {});
    const auto after_s = [last_ns](const auto& s) { return 1e-9 * static_cast<double>(s.at_ns - last_ns); };
    double last_active_s = 0.0;
    bool rested = false;
    for (const auto& s : seen) {
      if (subject_.rests(s.in))
        rested = true;
      else
        last_active_s = std::max(last_active_s, after_s(s));
    }
    const bool in_time = last_active_s <= kWatchdog_s + kMargin_s;
    const std::string silent_ms = in_text("%.0f ms", 1e3 * last_active_s);
    std::string text = "it " + std::string(Subject::kRests) + " 20 ms after the last datagram";
    const bool heard = std::ranges::any_of(seen, [&](const auto& s) { return after_s(s) > 0.1; });
    if (!heard)
      text = "it stops sending when it receives no datagrams";
    else if (!rested)
      text = "it does not react to 0.6 s without datagrams";
    else if (!in_time)
      text = "it " + std::string(Subject::kRests) + " only " + silent_ms + " after the last datagram";
    add(heard && rested && in_time, "watchdog", text,
        "the adapter must react 20 ms after the last valid datagram (rule 4), and must keep sending");
  }

  void goes_on() {
    const Seen seen = ask(Subject::kSettle_s);
    const bool does = !seen.empty() && subject_.does(seen.back().in);
    add(does, "resume",
        does ? "resumes at the next datagram" : "it does not resume after an interruption: " + said(seen),
        "the next valid datagram must clear the watchdog");
  }

  void restarts() {
    talk_->talk(0.1, {});
    talk_->begin();
    const Seen seen = ask(Subject::kSettle_s);
    const bool does = !seen.empty() && subject_.does(seen.back().in);
    add(does, "restart",
        does ? "accepts a restarted program" : "a restarted program is not accepted: " + said(seen),
        "from 20 ms after the last datagram, accept a new session that starts at sequence number 1 "
        "(rule 3)");
  }

  Seen ask(double seconds, const typename Talk::Beside& beside = {}) {
    return talk_->talk(
        seconds, [this](double t_s) { return subject_.ask(t_s); }, beside);
  }
  /// What the adapter reported instead of the commanded behaviour.
  [[nodiscard]] std::string said(const Seen& seen) const {
    if (seen.empty()) return "no more datagrams arrive";
    const auto other =
        std::ranges::find_if(seen, [this](const auto& s) { return !s.excused && !subject_.does(s.in); });
    return subject_.reported(other == seen.end() ? seen.back().in : other->in);
  }

  std::string address_;
  Subject subject_;
  std::optional<Talk> talk_;
  Section section_;
};

}  // namespace

Section check_device_adapter(const std::string& address, double force_n, const std::string& device_file) {
  std::optional<DeviceConfig> device;
  if (!device_file.empty()) device = described_device(device_file);
  return AdapterCheck<DeviceSubject>(address, DeviceSubject(force_n, std::move(device))).run();
}

Section check_robot_adapter(const std::string& address, double move_rad) {
  return AdapterCheck<RobotSubject>(address, RobotSubject(move_rad)).run();
}

}  // namespace longreach

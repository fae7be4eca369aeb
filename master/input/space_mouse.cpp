#include "master/input/space_mouse.hpp"

#include <dlfcn.h>
#include <spnav.h>
#include <sys/socket.h>

#include <array>
#include <stdexcept>

namespace longreach {
namespace {

constexpr const char* kSpnavLibrary = "libspnav.so.0";
constexpr double kFull = 350.0;      // full deflection of an axis as reported by the daemon
constexpr double kRetry_s = 1.0;     // interval of attempts to connect to the daemon
constexpr int kEventsPerPoll = 256;  // so that a flood of events cannot block the poll

struct Spnav {
  decltype(&spnav_open) open;
  decltype(&spnav_close) close;
  decltype(&spnav_fd) fd;
  decltype(&spnav_poll_event) poll;
  decltype(&spnav_protocol) protocol;
  decltype(&spnav_dev_name) device_name;

  Spnav() {
    void* const library = dlopen(kSpnavLibrary, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
      throw std::runtime_error(std::string("a SpaceMouse needs libspnav, but ") + kSpnavLibrary +
                               " cannot be loaded; install libspnav0 and spacenavd (deploy/setup)");
    const auto take = [library](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr)
        throw std::runtime_error(std::string(kSpnavLibrary) + " has no function " + name);
    };
    take(open, "spnav_open");
    take(close, "spnav_close");
    take(fd, "spnav_fd");
    take(poll, "spnav_poll_event");
    take(protocol, "spnav_protocol");
    take(device_name, "spnav_dev_name");
  }
};

// The first two buttons exist on every SpaceMouse.
constexpr auto kButtons = std::to_array<PadButton>(
    {PadButton::kEngage, PadButton::kStop, PadButton::kMode, PadButton::kGripper, PadButton::kClutch,
     PadButton::kScaleUp, PadButton::kScaleDown, PadButton::kHome, PadButton::kKvUp, PadButton::kKvDown});

}  // namespace

struct SpaceMouse::State {
  void find_daemon(double dt_s);
  void leave();
  [[nodiscard]] bool hung_up() const;
  void take(const spnav_event& event);

  Spnav spnav;
  bool open = false;
  double retry_s = 0.0;
  AxisSample sample{};
};

void SpaceMouse::State::find_daemon(double dt_s) {
  retry_s -= dt_s;
  if (retry_s > 0.0) return;
  retry_s = kRetry_s;
  if (spnav.open() != 0) return;
  open = true;
  std::array<char, 128> name{};
  // The old protocol has no query for whether there is a device.
  sample.present = spnav.protocol() < 1 || spnav.device_name(name.data(), static_cast<int>(name.size())) >= 0;
}

void SpaceMouse::State::leave() {
  if (open) spnav.close();
  open = false;
  sample = {};
}

bool SpaceMouse::State::hung_up() const {
  char byte = 0;
  return ::recv(spnav.fd(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
}

void SpaceMouse::State::take(const spnav_event& event) {
  if (event.type == SPNAV_EVENT_MOTION) {
    const spnav_event_motion& m = event.motion;
    // In the daemon's frame, x points right, y up and z towards the user.
    sample.push = Vector3(-m.z, -m.x, m.y) / kFull;
    sample.twist = Vector3(-m.rz, -m.rx, m.ry) / kFull;
    ++sample.reports;
  } else if (event.type == SPNAV_EVENT_BUTTON) {
    const auto k = static_cast<std::size_t>(event.button.bnum);
    if (k >= kButtons.size()) return;
    const std::uint32_t bit = 1U << static_cast<unsigned>(kButtons[k]);
    sample.buttons = event.button.press != 0 ? sample.buttons | bit : sample.buttons & ~bit;
  } else if (event.type == SPNAV_EVENT_DEV) {
    sample = {.present = event.dev.op == SPNAV_DEV_ADD};
  }
}

SpaceMouse::SpaceMouse() : state_(std::make_unique<State>()) {}
SpaceMouse::~SpaceMouse() { state_->leave(); }

AxisSample SpaceMouse::poll(double dt_s) {
  State& s = *state_;
  if (!s.open) s.find_daemon(dt_s);
  if (!s.open) return {};
  spnav_event event{};
  for (int i = 0; i < kEventsPerPoll && s.spnav.poll(&event) != 0; ++i) s.take(event);
  if (s.hung_up()) s.leave();
  return s.sample;
}

std::string_view SpaceMouse::key_line() {
  return "puck: the hand   left button: engage   right button: stop   more buttons: mode, gripper, clutch, "
         "scale up, scale down, home, kv up, kv down";
}

}  // namespace longreach

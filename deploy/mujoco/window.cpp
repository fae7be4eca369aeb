#include "deploy/mujoco/window.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace longreach {
namespace {

constexpr int kWidth = 960, kHeight = 640, kGeoms = 2000;
constexpr auto kFrame = std::chrono::milliseconds(33);

/// Why GLFW could not do the last thing.
std::string glfw_problem() {
  const char* why = nullptr;
  glfwGetError(&why);
  return why ? why : "no cause given";
}

/// What mouse and keys change.
struct View {
  const mjModel* model;
  mjvCamera camera{};
  mjvScene scene{};
  double x = 0.0, y = 0.0;         // of the mouse, pixels
  std::atomic<bool> reset{false};  // asked for by a key

  void turn(GLFWwindow* window, int action, double dx, double dy) {
    int width = 1, height = 1;
    glfwGetWindowSize(window, &width, &height);
    if (height > 0) mjv_moveCamera(model, action, dx / height, dy / height, &scene, &camera);
  }
};

View& view_of(GLFWwindow* window) { return *static_cast<View*>(glfwGetWindowUserPointer(window)); }

void on_mouse(GLFWwindow* window, double x, double y) {
  View& view = view_of(window);
  const double dx = x - view.x, dy = y - view.y;
  view.x = x, view.y = y;
  if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS)
    view.turn(window, mjMOUSE_ROTATE_V, dx, 0.0), view.turn(window, mjMOUSE_ROTATE_V, 0.0, dy);
  if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS)
    view.turn(window, mjMOUSE_MOVE_V, dx, dy);
}

void on_wheel(GLFWwindow* window, double /*x*/, double y) {
  view_of(window).turn(window, mjMOUSE_ZOOM, 0.0, -20.0 * y);
}

void on_key(GLFWwindow* window, int key, int /*code*/, int action, int /*modifiers*/) {
  if (key == GLFW_KEY_R && action == GLFW_PRESS) view_of(window).reset = true;
}

}  // namespace

/// The thread that draws. The state `shown_` belongs to it, except while `wanted_` is set.
class MujocoWindow::Drawing {
 public:
  explicit Drawing(const MujocoWorld& world)
      : view_{&world.model()},
        title_("longreach-mujoco: " + world.name()),
        shown_(mj_copyData(nullptr, &world.model(), &world.data()), mj_deleteData) {
    std::promise<std::string> opened;
    std::future<std::string> problem = opened.get_future();
    thread_ = std::thread([this, mine = std::move(opened)]() mutable { run(mine); });
    const std::string why = problem.get();
    if (why.empty()) return;
    thread_.join();
    throw std::runtime_error("--view: no window can be opened (" + why + "); it needs a display with OpenGL");
  }
  ~Drawing() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  void take(const mjData& state) {
    if (!wanted_.load(std::memory_order_acquire)) return;
    mj_copyData(shown_.get(), view_.model, &state);
    wanted_.store(false, std::memory_order_release);
  }
  [[nodiscard]] bool takes_reset() { return view_.reset.exchange(false); }
  [[nodiscard]] bool closed() const { return closed_; }

 private:
  void run(std::promise<std::string>& opened) {
    GLFWwindow* window = open();
    opened.set_value(window ? "" : glfw_problem());
    if (window) {
      draw_until_closed(window);
      glfwDestroyWindow(window);
    }
    glfwTerminate();
    closed_ = true;
  }

  GLFWwindow* open() {
    if (glfwInit() == GLFW_FALSE) return nullptr;
    GLFWwindow* window = glfwCreateWindow(kWidth, kHeight, title_.c_str(), nullptr, nullptr);
    if (!window) return nullptr;
    glfwMakeContextCurrent(window);
    glfwSwapInterval(0);
    glfwSetWindowUserPointer(window, &view_);
    glfwSetCursorPosCallback(window, on_mouse);
    glfwSetScrollCallback(window, on_wheel);
    glfwSetKeyCallback(window, on_key);
    return window;
  }

  void draw_until_closed(GLFWwindow* window) {
    mjrContext context;
    mjr_defaultContext(&context);
    mjr_makeContext(view_.model, &context, mjFONTSCALE_100);
    mjv_defaultScene(&view_.scene);
    mjv_makeScene(view_.model, &view_.scene, kGeoms);
    mjv_defaultFreeCamera(view_.model, &view_.camera);
    mjvOption option;
    mjv_defaultOption(&option);
    option.flags[mjVIS_CONTACTFORCE] = 1;
    auto due = std::chrono::steady_clock::now();
    while (!ended_ && glfwWindowShouldClose(window) == GLFW_FALSE) {
      glfwPollEvents();
      if (!wanted_.load(std::memory_order_acquire)) {
        draw(window, option, context);
        wanted_.store(true, std::memory_order_release);
      }
      due = std::max(due + kFrame, std::chrono::steady_clock::now());
      std::this_thread::sleep_until(due);
    }
    mjv_freeScene(&view_.scene);
    mjr_freeContext(&context);
  }

  void draw(GLFWwindow* window, const mjvOption& option, mjrContext& context) {
    mjrRect all{0, 0, 0, 0};
    glfwGetFramebufferSize(window, &all.width, &all.height);
    mjv_updateScene(view_.model, shown_.get(), &option, nullptr, &view_.camera, mjCAT_ALL, &view_.scene);
    mjr_render(all, &view_.scene, &context);
    char time[40];
    std::snprintf(time, sizeof time, "%.1f s\n%d", shown_->time, shown_->ncon);
    mjr_overlay(mjFONT_NORMAL, mjGRID_TOPLEFT, all, "time\ncontacts", time, &context);
    mjr_overlay(mjFONT_NORMAL, mjGRID_BOTTOMLEFT, all, "mouse\nR", "turn, move, zoom\nback to the start",
                &context);
    glfwSwapBuffers(window);
  }

  View view_;
  std::string title_;
  std::unique_ptr<mjData, void (*)(mjData*)> shown_;
  std::atomic<bool> wanted_{false}, ended_{false}, closed_{false};
  std::thread thread_;
};

MujocoWindow::MujocoWindow(const MujocoWorld& world)
    : world_(world), drawing_(std::make_unique<Drawing>(world)) {}
MujocoWindow::~MujocoWindow() = default;
void MujocoWindow::show() { drawing_->take(world_.data()); }
bool MujocoWindow::takes_reset() { return drawing_->takes_reset(); }
bool MujocoWindow::closed() const { return drawing_->closed(); }

}  // namespace longreach

// A slave that listens on all addresses of its host, reached by the second one from another host. The hosts are
// network namespaces.
#include <thread>

#include "tests/support/station.hpp"

namespace longreach {
namespace {

// $1: where the slave listens, $2: host at which the master looks for it, $3: programs.
const std::string kTwoHosts = R"sh(
unshare --net sleep 1000 &
far=$!
until [ "$(readlink /proc/$far/ns/net)" != "$(readlink /proc/self/ns/net)" ]; do sleep 0.01; done
on_far="nsenter --target $far --net --"
ip link add near type veth peer name far netns $far
ip link set lo up && $on_far ip link set lo up
ip address add 10.9.0.1/24 dev near && ip address add fd09::1/64 dev near nodad && ip link set near up
for n in 2 3; do
  $on_far ip address add 10.9.0.$n/24 dev far && $on_far ip address add fd09::$n/64 dev far nodad
done
$on_far ip link set far up
$on_far "$3"/longreach-slave --set link.listen="$1:47001" --set rpc.listen="$1:47020" &
"$3"/longreach-master --set link.slave="$2:47001" --set link.listen="$4" --operator none --engage --view plain
)sh";

struct Case {
  const char *listen, *host, *master;
};
class Addresses : public ::testing::TestWithParam<Case> {};

TEST_P(Addresses, TheSecondOneOfAHostIsAnsweredFromItself) {
  const auto& [listen, host, master] = GetParam();
  (void)test_site(RpcRole::kClient);
  RunningProgram hosts("/usr/bin/unshare",
                       {"--net", "--pid", "--fork", "--kill-child", "--mount-proc", "--", "/bin/bash", "-c",
                        kTwoHosts, "-", listen, host, LONGREACH_BIN, master});
  const auto says = [&hosts](const std::string& words) {
    return hosts.output().find(words) != std::string::npos;
  };
  for (int i = 0; i < 1200 && !says(" Engaged ") && hosts.running(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(says(" Engaged ")) << hosts.output();
  EXPECT_FALSE(says("arrived from other addresses")) << hosts.output();
}

INSTANTIATE_TEST_SUITE_P(
    Addresses, Addresses,
    ::testing::Values(Case{"0.0.0.0", "10.9.0.3", "0.0.0.0:0"}, Case{"[::]", "[fd09::3]", "[::]:0"},
                      Case{"[::]", "10.9.0.3", "[::]:0"}),
    [](const auto& one) {
      return std::string(one.index == 0 ? "IPv4" : one.index == 1 ? "IPv6" : "IPv4OnIPv6");
    });

}  // namespace
}  // namespace longreach

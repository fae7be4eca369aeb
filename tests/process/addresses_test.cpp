// A slave that listens on all addresses of its host, reached by the second one from another host, and a master behind an
// address translation whose outer address and port change. The hosts are network namespaces.
#include <thread>

#include "tests/support/station.hpp"

namespace longreach::addresses_test {
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

// A router with an address translation is between both. While the robot is engaged, the outer address of the router
// changes, and with it the address and port that the slave receives datagrams from.
// $1: iptables or ip6tables, $2: outer address, $3: prefix length, $4: where both listen, $5: outer address afterwards,
// $6: programs, $7: slave.
const std::string kTranslation = R"sh(
unshare --net sleep 1000 &
far=$!
unshare --net sleep 1000 &
home=$!
for host in $far $home; do
  until [ "$(readlink /proc/$host/ns/net)" != "$(readlink /proc/self/ns/net)" ]; do sleep 0.01; done
done
on_far="nsenter --target $far --net --" on_home="nsenter --target $home --net --"
ip link add out type veth peer name far netns $far
ip link add in type veth peer name home netns $home
$on_far ip address add 10.9.0.3/24 dev far && $on_far ip address add fd09::3/64 dev far nodad
$on_home ip address add 10.8.0.1/24 dev home && $on_home ip address add fd08::1/64 dev home nodad
ip address add 10.8.0.2/24 dev in && ip address add fd08::2/64 dev in nodad
ip address add $2/$3 dev out nodad 2>/dev/null
for link in lo in out; do ip link set $link up; done
$on_far ip link set far up && $on_home ip link set lo up && $on_home ip link set home up
$on_home ip route add default via 10.8.0.2 && $on_home ip -6 route add default via fd08::2
echo 1 >/proc/sys/net/ipv4/ip_forward && echo 1 >/proc/sys/net/ipv6/conf/all/forwarding
$1 --table nat --append POSTROUTING --out-interface out --jump MASQUERADE --random || exit
$on_far $1 --append INPUT --protocol udp --source $5
arrived() { $on_far $1 --list INPUT --verbose --exact --numeric | awk 'NR == 3 { print $1 }'; }
$on_far "$6"/longreach-slave --set link.listen="$4:47001" --set rpc.listen="$4:47020" &
$on_home "$6"/longreach-master --set link.slave="$7:47001" --set link.listen="$4:0" --operator none --engage \
  --view none &
until [[ $($on_home "$6"/longreach --slave "$7:47020" status 2>&1) == *Engaged*Engaged* ]]; do sleep 0.1; done
ip address del $2/$3 dev out && ip address add $5/$3 dev out nodad 2>/dev/null
until [ "$(arrived $1)" -gt 600 ]; do sleep 0.1; done
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

struct Translation {
  const char *tables, *before, *prefix, *listen, *after, *slave;
};
class Translations : public ::testing::TestWithParam<Translation> {};

TEST_P(Translations, ThatChangesTheAddressOfTheMasterDoesNotEndTheSession) {
  const auto& [tables, before, prefix, listen, after, slave] = GetParam();
  (void)test_site(RpcRole::kClient);
  RunningProgram hosts("/usr/bin/unshare",
                       {"--net", "--pid", "--fork", "--kill-child", "--mount-proc", "--", "/bin/bash", "-c",
                        kTranslation, "-", tables, before, prefix, listen, after, LONGREACH_BIN, slave});
  // It ends when 600 datagrams have arrived from the new address.
  EXPECT_EQ(hosts.wait(std::chrono::seconds(60)), 0) << hosts.output();
  const std::string said = hosts.output();
  EXPECT_NE(said.find("to=Engaged"), std::string::npos) << said;
  EXPECT_EQ(said.find("to=Holding"), std::string::npos) << said;
  const std::string session = "slave session number=";
  EXPECT_EQ(said.find(session), said.rfind(session)) << said;
}

INSTANTIATE_TEST_SUITE_P(
    Addresses, Translations,
    ::testing::Values(Translation{"iptables", "10.9.0.1", "24", "0.0.0.0", "10.9.0.9", "10.9.0.3"},
                      Translation{"ip6tables", "fd09::1", "64", "[::]", "fd09::9", "[fd09::3]"}),
    [](const auto& one) { return std::string(one.index == 0 ? "IPv4" : "IPv6"); });

INSTANTIATE_TEST_SUITE_P(
    Addresses, Addresses,
    ::testing::Values(Case{"0.0.0.0", "10.9.0.3", "0.0.0.0:0"}, Case{"[::]", "[fd09::3]", "[::]:0"},
                      Case{"[::]", "10.9.0.3", "[::]:0"}),
    [](const auto& one) {
      return std::string(one.index == 0 ? "IPv4" : one.index == 1 ? "IPv6" : "IPv4OnIPv6");
    });

}  // namespace
}  // namespace longreach::addresses_test

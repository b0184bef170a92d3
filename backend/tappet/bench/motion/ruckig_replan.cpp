// Trajectories of Ruckig from states in flight to positions, one at each call: the moves of `axes.py` in C++.
#include <ruckig/ruckig.hpp>

namespace {
ruckig::Ruckig<1> planner;
ruckig::InputParameter<1> input;
ruckig::Trajectory<1> trajectory;
bool away = false;
bool ready = false;
double time_gone = 0.0;
}  // namespace

extern "C" {
double result = 0.0;

void cycle() {
    if (!ready) {
        input.max_velocity[0] = 50.0;
        input.max_acceleration[0] = 20.0;
        input.max_jerk[0] = 200.0;
        ready = true;
    } else {
        trajectory.at_time(0.002, input.current_position[0], input.current_velocity[0],
                           input.current_acceleration[0]);
    }
    away = !away;
    input.target_position[0] = away ? TARGET : OTHER;
    planner.calculate(input, trajectory);
    result = trajectory.get_duration();
}
}

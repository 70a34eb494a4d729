//! Stands a Go2 up and lets it crouch again by rt/lowcmd, and prints what it read of rt/lowstate as
//! one JSON object, through RustDDS, an implementation of DDS that shares no code with Cyclone. The
//! messages are written out here once more, and nobody is told of their types beyond the names.
//!
//! The robot has to lie, its motors released (`understudy exec go2 --released`).

use std::process::exit;
use std::thread::sleep;
use std::time::{Duration, Instant};

use rustdds::no_key::{DataReader, DataWriter};
use rustdds::policy::{Durability, History, Reliability};
use rustdds::{DomainParticipantBuilder, QosPolicyBuilder, TopicKind};
use serde::{Deserialize, Serialize};

// Messages of the family go. [[u8; 20]; 2] is uint8[40] on the wire, as serde knows arrays of up to
// 32.

#[derive(Serialize, Deserialize, Clone, Default)]
struct ImuState {
    quaternion: [f32; 4], // w, x, y, z
    gyroscope: [f32; 3],
    accelerometer: [f32; 3],
    rpy: [f32; 3],
    temperature: u8,
}

#[derive(Serialize, Deserialize, Clone, Default)]
struct MotorState {
    mode: u8,
    floats: [f32; 7], // q, dq, ddq, tau_est, q_raw, dq_raw, ddq_raw
    temperature: u8,
    lost: u32,
    reserve: [u32; 2],
}

#[derive(Serialize, Deserialize, Clone, Default)]
struct BmsState {
    bytes: [u8; 4], // version_high, version_low, status, soc
    current: i32,
    cycle: u16,
    ntc: [u8; 4],
    cell_vol: [u16; 15],
}

#[derive(Serialize, Deserialize, Clone, Default)]
struct LowState {
    head: [u8; 4], // head, level_flag, frame_reserve
    sn: [u32; 2],
    version: [u32; 2],
    bandwidth: u16,
    imu_state: ImuState,
    motor_state: [MotorState; 20],
    bms_state: BmsState,
    foot_force: [i16; 4],
    foot_force_est: [i16; 4],
    tick: u32, // ms
    wireless_remote: [[u8; 20]; 2],
    bit_flag: u8,
    adc_reel: f32,
    ntc: [u8; 2],
    power: [f32; 2], // V, A
    fan_frequency: [u16; 4],
    reserve: u32,
    crc: u32,
}

#[derive(Serialize, Deserialize, Clone, Debug, Default)]
struct MotorCmd {
    mode: u8,
    floats: [f32; 5], // q, dq, tau, kp, kd
    reserve: [u32; 3],
}

#[derive(Serialize, Deserialize, Clone, Debug, Default)]
struct LowCmd {
    head: [u8; 4],
    sn: [u32; 2],
    version: [u32; 2],
    bandwidth: u16,
    motor_cmd: [MotorCmd; 20],
    bms_cmd: [u8; 4],
    wireless_remote: [[u8; 20]; 2],
    led: [u8; 12],
    fan: [u8; 2],
    gpio: u8,
    reserve: u32,
    crc: u32,
}

/// A message as C++ has it in memory, over which the robot computes the CRC: not as it is on the
/// wire, where a structure does not end on a multiple of its alignment.
#[derive(Default)]
struct Memory(Vec<u8>);

impl Memory {
    fn align(&mut self, size: usize) -> &mut Self {
        while self.0.len() % size != 0 {
            self.0.push(0);
        }
        self
    }
    fn put<const N: usize>(&mut self, values: impl IntoIterator<Item = [u8; N]>) -> &mut Self {
        for value in values {
            self.align(N).0.extend(value);
        }
        self
    }
    fn bytes(&mut self, values: &[u8]) -> &mut Self {
        self.put(values.iter().map(|value| [*value]))
    }
    fn u16s(&mut self, values: &[u16]) -> &mut Self {
        self.put(values.iter().map(|value| value.to_le_bytes()))
    }
    fn i16s(&mut self, values: &[i16]) -> &mut Self {
        self.put(values.iter().map(|value| value.to_le_bytes()))
    }
    fn u32s(&mut self, values: &[u32]) -> &mut Self {
        self.put(values.iter().map(|value| value.to_le_bytes()))
    }
    fn f32s(&mut self, values: &[f32]) -> &mut Self {
        self.put(values.iter().map(|value| value.to_le_bytes()))
    }

    /// Over 32-bit words, highest bit first, without reflection and final xor.
    fn crc(&mut self) -> u32 {
        self.align(4);
        self.0.chunks_exact(4).fold(0xFFFF_FFFF, |crc: u32, word| {
            let word = u32::from_le_bytes(word.try_into().unwrap());
            (0..32).rev().fold(crc, |crc, bit| {
                let xor = if (crc >> 31) ^ (word >> bit & 1) != 0 {
                    0x04C1_1DB7
                } else {
                    0
                };
                (crc << 1) ^ xor
            })
        })
    }
}

fn crc_of_state(state: &LowState) -> u32 {
    let mut memory = Memory::default();
    memory
        .bytes(&state.head)
        .u32s(&state.sn)
        .u32s(&state.version)
        .u16s(&[state.bandwidth]);
    let imu = &state.imu_state;
    memory
        .f32s(&imu.quaternion)
        .f32s(&imu.gyroscope)
        .f32s(&imu.accelerometer)
        .f32s(&imu.rpy);
    memory.bytes(&[imu.temperature]).align(4);
    for motor in &state.motor_state {
        memory
            .bytes(&[motor.mode])
            .f32s(&motor.floats)
            .bytes(&[motor.temperature]);
        memory.u32s(&[motor.lost]).u32s(&motor.reserve);
    }
    let bms = &state.bms_state;
    memory
        .bytes(&bms.bytes)
        .put([bms.current.to_le_bytes()])
        .u16s(&[bms.cycle])
        .bytes(&bms.ntc);
    memory.u16s(&bms.cell_vol).align(4);
    memory
        .i16s(&state.foot_force)
        .i16s(&state.foot_force_est)
        .u32s(&[state.tick]);
    memory
        .bytes(state.wireless_remote.as_flattened())
        .bytes(&[state.bit_flag])
        .f32s(&[state.adc_reel]);
    memory
        .bytes(&state.ntc)
        .f32s(&state.power)
        .u16s(&state.fan_frequency)
        .u32s(&[state.reserve]);
    memory.crc()
}

fn crc_of_command(command: &LowCmd) -> u32 {
    let mut memory = Memory::default();
    memory
        .bytes(&command.head)
        .u32s(&command.sn)
        .u32s(&command.version)
        .u16s(&[command.bandwidth]);
    for motor in &command.motor_cmd {
        memory
            .align(4)
            .bytes(&[motor.mode])
            .f32s(&motor.floats)
            .u32s(&motor.reserve);
    }
    memory
        .bytes(&command.bms_cmd)
        .bytes(command.wireless_remote.as_flattened())
        .bytes(&command.led);
    memory
        .bytes(&command.fan)
        .bytes(&[command.gpio])
        .u32s(&[command.reserve]);
    memory.crc()
}

// The movement of programs/go2_stand_plan.py, but for its end, which is the crouch again. rad; FR,
// FL, RR, RL, each hip, thigh, calf.
const CROUCH: [f32; 12] = [
    0.0, 1.36, -2.65, 0.0, 1.36, -2.65, -0.2, 1.36, -2.65, 0.2, 1.36, -2.65,
];
const STAND: [f32; 12] = [
    0.0, 0.67, -1.3, 0.0, 0.67, -1.3, 0.0, 0.67, -1.3, 0.0, 0.67, -1.3,
];
const KP: f32 = 60.0; // N·m/rad
const KD: f32 = 5.0; // N·m·s/rad
const CROUCHED: f32 = 1.5; // s, when each stage ends
const RISEN: f32 = 3.0;
const HELD: f32 = 5.0;
const DONE: f32 = 7.0;

fn targets(start: &[f32; 12], t: f32) -> [f32; 12] {
    let blend = |from: &[f32; 12], to: &[f32; 12], share: f32| {
        std::array::from_fn(|i| from[i] + (to[i] - from[i]) * share.clamp(0.0, 1.0))
    };
    if t < CROUCHED {
        blend(start, &CROUCH, t / CROUCHED)
    } else if t < HELD {
        blend(&CROUCH, &STAND, (t - CROUCHED) / (RISEN - CROUCHED))
    } else {
        blend(&STAND, &CROUCH, (t - HELD) / (DONE - HELD - 0.2))
    }
}

fn joints(state: &LowState) -> [f32; 12] {
    std::array::from_fn(|slot| state.motor_state[slot].floats[0])
}

fn command(q: &[f32; 12]) -> LowCmd {
    let mut command = LowCmd {
        head: [0xFE, 0xEF, 0xFF, 0],
        ..Default::default()
    };
    for (motor, q) in command.motor_cmd.iter_mut().zip(q) {
        *motor = MotorCmd {
            mode: 1,
            floats: [*q, 0.0, 0.0, KP, KD],
            reserve: [0; 3],
        };
    }
    command.crc = crc_of_command(&command);
    command
}

/// What was read.
#[derive(Default)]
struct Reading {
    states: u32,
    crc_errors: u32,
    undecoded: u32,
    first_tick: u32,
    last: LowState,
}

impl Reading {
    /// Takes what has arrived.
    fn take(&mut self, reader: &mut DataReader<LowState>) {
        loop {
            match reader.take_next_sample() {
                Ok(Some(sample)) => {
                    self.last = sample.into_value();
                    if self.states == 0 {
                        self.first_tick = self.last.tick;
                    }
                    self.states += 1;
                    self.crc_errors += u32::from(crc_of_state(&self.last) != self.last.crc);
                }
                Ok(None) => return,
                Err(error) => {
                    eprintln!("{error:?}");
                    self.undecoded += 1;
                }
            }
        }
    }
}

fn main() {
    let begin = Instant::now();
    let quality = |reliability| {
        QosPolicyBuilder::new()
            .reliability(reliability)
            .durability(Durability::Volatile)
            .history(History::KeepLast { depth: 64 })
            .build()
    };
    let best_effort = quality(Reliability::BestEffort);
    let reliable = quality(Reliability::Reliable {
        max_blocking_time: rustdds::Duration::from_millis(100),
    });
    let participant = DomainParticipantBuilder::new(0)
        .build()
        .expect("a participant");
    let topic = |name: &str, kind: &str| {
        participant
            .create_topic(
                name.into(),
                format!("unitree_go::msg::dds_::{kind}"),
                &best_effort,
                TopicKind::NoKey,
            )
            .expect("a topic")
    };
    let subscriber = participant
        .create_subscriber(&best_effort)
        .expect("a subscriber");
    let publisher = participant
        .create_publisher(&reliable)
        .expect("a publisher");
    let mut reader: DataReader<LowState> = subscriber
        .create_datareader_no_key(
            &topic("rt/lowstate", "LowState_"),
            Some(best_effort.clone()),
        )
        .expect("a reader");
    let writer: DataWriter<LowCmd> = publisher
        .create_datawriter_no_key(&topic("rt/lowcmd", "LowCmd_"), Some(reliable.clone()))
        .expect("a writer");

    let mut reading = Reading::default();
    while reading.states == 0 {
        if begin.elapsed() > Duration::from_secs(20) {
            eprintln!("no rt/lowstate within 20 s");
            exit(1);
        }
        sleep(Duration::from_millis(1));
        reading.take(&mut reader);
    }
    let first = begin.elapsed().as_secs_f64();
    let (start, start_tick) = (joints(&reading.last), reading.last.tick);
    let (mut commands, mut standing) = (0u32, [f32::NAN; 12]);
    let commanding = Instant::now();
    loop {
        reading.take(&mut reader);
        let t = (reading.last.tick - start_tick) as f32 / 1000.0;
        if t >= DONE {
            break;
        }
        if t > RISEN && t < HELD {
            standing = joints(&reading.last);
        }
        if commanding.elapsed() > Duration::from_secs(60) {
            eprintln!("the states stopped at {t} s");
            exit(1);
        }
        writer
            .write(command(&targets(&start, t)), None)
            .expect("a command is written");
        commands += 1;
        sleep(Duration::from_millis(2));
    }
    let state = &reading.last;
    println!(
        "{{\"first_state_s\": {first:.3}, \"seconds\": {:.3}, \"ticks_ms\": {}, \"states\": {}, \"crc_errors\": {}, \
         \"undecoded\": {}, \"commands\": {commands}, \"standing\": {standing:?}, \"quaternion\": {:?}, \"soc\": {}, \
         \"power_v\": {:.2}}}",
        commanding.elapsed().as_secs_f64(),
        state.tick - reading.first_tick,
        reading.states,
        reading.crc_errors,
        reading.undecoded,
        state.imu_state.quaternion,
        state.bms_state.bytes[3],
        state.power[0],
    );
}

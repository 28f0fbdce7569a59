//! sward on the GPU.

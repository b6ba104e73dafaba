"""A person of any size: masses, joints, arm, legs, gait and grip."""

"""What a network does near an operating point and in the frequency domain."""

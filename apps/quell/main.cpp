// The quell command.
int main() { return 0; }

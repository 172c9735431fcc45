// Plans a command and drives its policy to the end, as a robot would. C++17, libcurl and nlohmann/json:
//
//     apt install g++ libcurl4-openssl-dev nlohmann-json3-dev
//     g++ -std=c++17 -O2 robot.cpp -lcurl -o robot
//     ./robot [SERVER]
//
// In place of a robot's sensors this takes the states of the expected run: nothing slips in the world toys-4x1-cylinder.

#include <curl/curl.h>

#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>

using nlohmann::json;

/// A connection that is kept, as a control loop should: one call a step.
class Service {
public:
    explicit Service(std::string server) : server_(std::move(server)), curl_(curl_easy_init(), curl_easy_cleanup) {
        if (!curl_) throw std::runtime_error("curl cannot be initialised");
    }

    /// GET without a body, POST with one; throws what the service refuses with.
    json ask(const std::string& path, const json* body = nullptr) {
        CURL* curl = curl_.get();
        const std::string url = server_ + path, sent = body ? body->dump() : "";
        std::string received;
        std::unique_ptr<curl_slist, decltype(&curl_slist_free_all)> headers(
            curl_slist_append(nullptr, "Content-Type: application/json"), curl_slist_free_all);
        curl_easy_reset(curl);  // keeps the connection
        curl_easy_setopt(curl, CURLOPT_URL, url.c_str());
        curl_easy_setopt(curl, CURLOPT_TIMEOUT, 70L);  // longer than a plan is waited for
        curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, append);
        curl_easy_setopt(curl, CURLOPT_WRITEDATA, &received);
        if (body) {
            curl_easy_setopt(curl, CURLOPT_HTTPHEADER, headers.get());
            curl_easy_setopt(curl, CURLOPT_POSTFIELDSIZE, static_cast<long>(sent.size()));
            curl_easy_setopt(curl, CURLOPT_POSTFIELDS, sent.c_str());
        }
        if (const CURLcode code = curl_easy_perform(curl); code != CURLE_OK)
            throw std::runtime_error(url + ": " + curl_easy_strerror(code));
        long status = 0;
        curl_easy_getinfo(curl, CURLINFO_RESPONSE_CODE, &status);
        json answer = json::parse(received);
        if (status >= 400) throw std::runtime_error(answer.at("type").get<std::string>() + ": " + answer.at("detail").get<std::string>());
        return answer;
    }

private:
    static size_t append(char* data, size_t size, size_t count, void* to) {
        static_cast<std::string*>(to)->append(data, size * count);
        return size * count;
    }

    std::string server_;
    std::unique_ptr<CURL, decltype(&curl_easy_cleanup)> curl_;
};

/// What takes longer than a request waits is a job: ask until it ends.
json plan(Service& service, const json& request) {
    json answer = service.ask("/plan", &request);
    while (answer.contains("state")) {
        if (!answer["plan"].is_null()) return answer["plan"];
        if (!answer["error"].is_null()) throw std::runtime_error(answer["error"]["detail"].get<std::string>());
        if (answer["state"] == "cancelled") throw std::runtime_error("somebody cancelled the plan");
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        answer = service.ask(answer["url"].get<std::string>());
    }
    return answer;
}

int main(int count, char** arguments) try {
    curl_global_init(CURL_GLOBAL_DEFAULT);
    Service service(count > 1 ? arguments[1] : "http://127.0.0.1:8000");
    const json found = plan(service, {{"text", "Put the cylinder in the box, then put the box in the bedroom"},
                                      {"environment", "toys-4x1-cylinder"}});
    if (found["policy"].is_null()) throw std::runtime_error("there is no plan: " + found["outcome"].get<std::string>());
    std::cout << found["ltl"].get<std::string>() << ": probability " << found["probability"]["lower"] << '\n';
    const std::string path = found["policy"]["url"].get<std::string>() + "/step";
    json memory = found["initial"]["memory"];
    for (const json& place : found["trajectory"]) {
        const json observed = {{"state", place["state"]}, {"memory", memory}};
        const json step = service.ask(path, &observed);
        memory = step["memory"];
        std::cout << place["state"] << "  →  " << step[step["action"].is_null() ? "status" : "action"].get<std::string>() << '\n';
        if (step["status"] == "satisfied") return 0;
    }
    throw std::runtime_error("the run ended before the task was done");
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
